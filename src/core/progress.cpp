#include "core/progress.h"

#include "core/error.h"

namespace tenku {

void Progress::begin(std::string_view, std::size_t) {}
void Progress::advance(std::size_t) {}
void Progress::end(std::string_view) {}
bool Progress::is_cancelled() const { return false; }

void Progress::stop_if_cancelled() const {
  if (is_cancelled()) throw Cancelled();
}

}  // namespace tenku
