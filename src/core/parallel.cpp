#include "core/parallel.h"

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

namespace tenku {

void parallel_for(std::size_t count, std::size_t grain,
                  const std::function<void(IndexRange)>& body) {
  using Range = tbb::blocked_range<std::size_t>;
  tbb::parallel_for(
      Range(0, count, grain),
      [&](const Range& r) {
        body({r.begin(), r.end()});
      },
      tbb::simple_partitioner());
}

double parallel_sum(std::size_t count, std::size_t grain,
                    const std::function<double(IndexRange)>& body) {
  using Range = tbb::blocked_range<std::size_t>;
  return tbb::parallel_deterministic_reduce(
      Range(0, count, grain), 0.0,
      [&](const Range& r, double sum) {
        return sum + body({r.begin(), r.end()});
      },
      [](double a, double b) { return a + b; }, tbb::simple_partitioner());
}

ThreadLimit::ThreadLimit(unsigned threads) {
  if (threads == 0) return;
  control_ = new tbb::global_control(tbb::global_control::max_allowed_parallelism, threads);
}

ThreadLimit::~ThreadLimit() { delete static_cast<tbb::global_control*>(control_); }

unsigned thread_count() {
  return static_cast<unsigned>(
      tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
}

}  // namespace tenku
