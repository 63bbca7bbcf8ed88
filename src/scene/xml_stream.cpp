#include "scene/xml_stream.h"

#include <expat.h>

#include <exception>
#include <string>

#include "core/error.h"
#include "core/handle.h"
#include "scene/input_file.h"

namespace tenku {
namespace {

constexpr std::size_t kDeepest = 500;  // no city model is nested deeper than 40

std::string_view without_prefix(std::string_view name) {
  const auto colon = name.rfind(':');
  return colon == std::string_view::npos ? name : name.substr(colon + 1);
}

struct Walk {
  XML_Parser parser;
  XmlVisitor& visitor;
  const std::string& file;
  std::size_t depth = 0;
  std::exception_ptr failure = nullptr;

  std::string place() const {
    return file + ", line " + std::to_string(XML_GetCurrentLineNumber(parser)) + ": ";
  }
};

// The parser is written in C: no exception may pass through it.
template <class Call>
void guarded(void* data, const Call& call) {
  Walk& walk = *static_cast<Walk*>(data);
  if (walk.failure) return;
  try {
    call(walk);
  } catch (const InputError& error) {
    walk.failure = std::make_exception_ptr(InputError(walk.place() + error.what()));
  } catch (...) {
    walk.failure = std::current_exception();
  }
  if (walk.failure) XML_StopParser(walk.parser, XML_FALSE);
}

void on_begin(void* data, const XML_Char* name, const XML_Char** attributes) {
  guarded(data, [&](Walk& walk) {
    if (++walk.depth > kDeepest) throw InputError("elements are nested too deep");
    walk.visitor.begin_element(without_prefix(name), XmlAttributes(attributes));
  });
}

void on_end(void* data, const XML_Char* name) {
  guarded(data, [&](Walk& walk) {
    --walk.depth;
    walk.visitor.end_element(without_prefix(name));
  });
}

void on_text(void* data, const XML_Char* text, int length) {
  guarded(data, [&](Walk& walk) { walk.visitor.text({text, static_cast<std::size_t>(length)}); });
}

void feed(Walk& walk, std::string_view piece, bool is_last) {
  const XML_Status status =
      XML_Parse(walk.parser, piece.data(), static_cast<int>(piece.size()), is_last ? 1 : 0);
  if (walk.failure) std::rethrow_exception(walk.failure);
  if (status == XML_STATUS_OK) return;
  throw InputError(walk.place() +
                   "cut off, or not XML: " + XML_ErrorString(XML_GetErrorCode(walk.parser)));
}

}  // namespace

std::string_view XmlAttributes::operator()(std::string_view name) const {
  for (const char** pair = pairs_; *pair != nullptr; pair += 2) {
    if (without_prefix(pair[0]) == name) return pair[1];
  }
  return {};
}

std::string_view XmlAttributes::value_with(std::string_view text) const {
  for (const char** pair = pairs_; *pair != nullptr; pair += 2) {
    const std::string_view value = pair[1];
    if (value.find(text) != std::string_view::npos) return value;
  }
  return {};
}

void walk_xml(const std::filesystem::path& path, XmlVisitor& visitor, Progress& progress) {
  const Handle<XML_ParserStruct, &XML_ParserFree> parser(XML_ParserCreate(nullptr));
  if (!parser) throw ResourceError("expat could not be started");
  const std::string file = path.string();
  Walk walk{parser.get(), visitor, file};
  XML_SetUserData(parser.get(), &walk);
  XML_SetElementHandler(parser.get(), on_begin, on_end);
  XML_SetCharacterDataHandler(parser.get(), on_text);
  for_each_piece(path, [&](std::string_view piece) {
    progress.stop_if_cancelled();
    feed(walk, piece, false);
  });
  feed(walk, {}, true);
}

}  // namespace tenku
