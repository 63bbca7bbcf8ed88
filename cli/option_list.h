/// The options of a command. CLI11 stands behind, named in option_list.cpp and main.cpp alone: each
/// file that includes it takes ten seconds more to compile.
#pragma once

#include <string>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace tenku {

/// An option, to say more of it.
class AddedOption {
 public:
  explicit AddedOption(CLI::Option* option) : option_(option) {}

  AddedOption required(bool is_required = true);
  AddedOption description(const std::string& text);
  AddedOption split_at(char delimiter);  ///< one word for several values
  AddedOption given_again();             ///< one value each time, kept in order

 private:
  CLI::Option* option_;
};

/// Adds options to a command; `value` must outlive it.
class OptionList {
 public:
  explicit OptionList(CLI::App& app) : app_(app) {}

  /// @param names   `--out`, `-o,--out`, or `SCENE` for what stands by itself
  /// @tparam Value  one of those in option_list.cpp
  template <class Value>
  AddedOption add_option(const std::string& names, Value& value, const std::string& description);
  AddedOption add_flag(const std::string& names, bool& value, const std::string& description);

  AddedOption get_option(const std::string& name);
  void remove_option(const std::string& name);

 private:
  CLI::App& app_;
};

}  // namespace tenku
