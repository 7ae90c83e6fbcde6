#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

namespace halfsilver {

// Threads that wait for work, so that none has to be started within a frame. Jobs begin in the order in which they were
// started; the chunks of one run in any order, on all threads at once.
class WorkerPool {
 public:
  class Job {
   public:
    // From the beginning of its first chunk to the end of its last one. Only after wait().
    double milliseconds() const { return std::chrono::duration<double, std::milli>(end_ - begin_).count(); }

   private:
    friend class WorkerPool;
    std::function<void(std::size_t)> work_;
    std::size_t chunks_ = 0;
    std::size_t taken_ = 0, done_ = 0;  // under the pool's mutex, as the times
    std::chrono::steady_clock::time_point begin_, end_;
  };

  explicit WorkerPool(unsigned threads);
  ~WorkerPool();  // the jobs that were started are done first
  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;

  // Has work(0) to work(chunks - 1) run, and returns at once. `work` must not throw.
  std::shared_ptr<const Job> start(std::size_t chunks, std::function<void(std::size_t)> work);
  void wait(const Job& job);

 private:
  void run();
  void close();  // the threads end when no work is left

  std::mutex mutex_;
  std::condition_variable workCame_, jobEnded_;
  std::deque<std::shared_ptr<Job>> waiting_;  // with chunks that nobody has taken
  bool closing_ = false;
  std::vector<std::jthread> threads_;
};

}  // namespace halfsilver
