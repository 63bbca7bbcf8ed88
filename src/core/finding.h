/// Flaws in the user's model or in a method's result that do not stop the work.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace tenku {

enum class Severity { Note, Warning, Error };

constexpr std::string_view name_of(Severity severity) {
  switch (severity) {
    case Severity::Note:
      return "note";
    case Severity::Warning:
      return "warning";
    case Severity::Error:
      return "error";
  }
  return "";
}

/// One flaw, or `count` of the same kind at the same object. Reaches the log, `--json` and the
/// report.
struct Finding {
  std::string code;  ///< short and stable, such as `zero_area_face`
  Severity severity = Severity::Warning;
  std::string object;  ///< object id, or empty
  std::string where;   ///< file and line, ring, coordinates
  std::string what;    ///< a sentence without a full stop
  std::string repair;  ///< what was done about it, or could be
  std::size_t count = 1;
};

}  // namespace tenku
