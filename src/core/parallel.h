/// Parallel loops whose results do not depend on the number of threads.
#pragma once

#include <cstddef>
#include <functional>

namespace tenku {

/// Half-open range of indices, handed to a loop body.
struct IndexRange {
  std::size_t begin = 0, end = 0;
};

/// Calls `body` on consecutive ranges of at most `grain` indices that cover [0, count).
/// Each call writes only to its own indices. An exception thrown by `body` is rethrown here.
void parallel_for(std::size_t count, std::size_t grain,
                  const std::function<void(IndexRange)>& body);

/// Sum over [0, count) of the partial sums that `body` returns, added in a fixed tree order:
/// bit-identical for any number of threads, given the same `count` and `grain`.
double parallel_sum(std::size_t count, std::size_t grain,
                    const std::function<double(IndexRange)>& body);

/// Limits the threads of all parallel loops while it lives; 0 leaves the machine's number.
class ThreadLimit {
 public:
  explicit ThreadLimit(unsigned threads);
  ~ThreadLimit();
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

 private:
  void* control_ = nullptr;
};

/// Number of threads that a loop started now may use.
unsigned thread_count();

}  // namespace tenku
