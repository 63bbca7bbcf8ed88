#include "cli/option_list.h"

#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>
#include <vector>

namespace tenku {

AddedOption AddedOption::required(bool is_required) {
  option_->required(is_required);
  return *this;
}

AddedOption AddedOption::description(const std::string& text) {
  option_->description(text);
  return *this;
}

AddedOption AddedOption::split_at(char delimiter) {
  option_->delimiter(delimiter);
  return *this;
}

AddedOption AddedOption::given_again() {
  option_->expected(1)->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  return *this;
}

template <class Value>
AddedOption OptionList::add_option(const std::string& names, Value& value,
                                   const std::string& description) {
  return AddedOption(app_.add_option(names, value, description));
}

AddedOption OptionList::add_flag(const std::string& names, bool& value,
                                 const std::string& description) {
  return AddedOption(app_.add_flag(names, value, description));
}

AddedOption OptionList::get_option(const std::string& name) {
  return AddedOption(app_.get_option(name));
}

void OptionList::remove_option(const std::string& name) {
  app_.remove_option(app_.get_option(name));
}

#define TENKU_OPTION_VALUE(...)                                                             \
  template AddedOption OptionList::add_option(const std::string& names, __VA_ARGS__& value, \
                                              const std::string& description)
TENKU_OPTION_VALUE(std::string);
TENKU_OPTION_VALUE(std::optional<std::string>);
TENKU_OPTION_VALUE(std::vector<std::string>);
TENKU_OPTION_VALUE(double);
TENKU_OPTION_VALUE(std::optional<double>);
TENKU_OPTION_VALUE(int);
TENKU_OPTION_VALUE(std::optional<int>);
TENKU_OPTION_VALUE(unsigned);
TENKU_OPTION_VALUE(std::size_t);
TENKU_OPTION_VALUE(std::optional<std::int64_t>);
#undef TENKU_OPTION_VALUE

}  // namespace tenku
