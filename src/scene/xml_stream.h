/// XML that is walked through while it is read, so that memory does not follow the file.
#pragma once

#include <filesystem>
#include <string_view>

#include "core/progress.h"

namespace tenku {

/// Attributes of one element.
class XmlAttributes {
 public:
  /// @param pairs  names and values in turn, ended by a null pointer
  explicit XmlAttributes(const char** pairs) : pairs_(pairs) {}

  /// Value of the attribute with this name, whatever its prefix; empty if there is none.
  std::string_view operator()(std::string_view name) const;
  /// True if some value contains `text`.
  std::string_view value_with(std::string_view text) const;

 private:
  const char** pairs_;
};

/// What a walk meets, in the order of the file. Names come without their prefix. An InputError
/// thrown here stops the walk, and reaches the caller with file and line before its message.
class XmlVisitor {
 public:
  virtual ~XmlVisitor() = default;
  virtual void begin_element(std::string_view name, const XmlAttributes& attributes) = 0;
  virtual void end_element(std::string_view name) = 0;
  /// Text of an element, in any number of pieces.
  virtual void text(std::string_view piece) = 0;
};

/// Walks through an XML file, also one packed by gzip.
///
/// Source   W3C, "Extensible Markup Language (XML) 1.0"; read by expat, which loads nothing from
///          elsewhere and refuses entities that multiply.
/// Cost     memory does not depend on the size of the file; 4 s a gigabyte and what the visitor
///          takes.
/// @throws InputError  as `read_input_file`; not well-formed, cut off, nested deeper than 500
void walk_xml(const std::filesystem::path& path, XmlVisitor& visitor, Progress& progress);

}  // namespace tenku
