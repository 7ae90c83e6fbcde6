#include "exact/worker_pool.h"

#include <utility>

namespace halfsilver {

using Clock = std::chrono::steady_clock;

WorkerPool::WorkerPool(unsigned threads) {
  try {
    for (unsigned i = 0; i < threads; ++i) threads_.emplace_back([this] { run(); });
  } catch (...) {
    close();  // or the threads that were made would be joined while they wait for work
    throw;
  }
}

WorkerPool::~WorkerPool() { close(); }

void WorkerPool::close() {
  {
    const std::lock_guard lock(mutex_);
    closing_ = true;
  }
  workCame_.notify_all();
}

std::shared_ptr<const WorkerPool::Job> WorkerPool::start(std::size_t chunks, std::function<void(std::size_t)> work) {
  const auto job = std::make_shared<Job>();
  job->work_ = std::move(work);
  job->chunks_ = chunks;
  if (chunks == 0) return job;
  {
    const std::lock_guard lock(mutex_);
    waiting_.push_back(job);
  }
  workCame_.notify_all();
  return job;
}

void WorkerPool::wait(const Job& job) {
  std::unique_lock lock(mutex_);
  jobEnded_.wait(lock, [&job] { return job.done_ == job.chunks_; });
}

void WorkerPool::run() {
  std::unique_lock lock(mutex_);
  while (true) {
    workCame_.wait(lock, [this] { return closing_ || !waiting_.empty(); });
    if (waiting_.empty()) return;
    const std::shared_ptr<Job> job = waiting_.front();
    const std::size_t chunk = job->taken_++;
    if (chunk == 0) job->begin_ = Clock::now();
    if (job->taken_ == job->chunks_) waiting_.pop_front();
    lock.unlock();
    job->work_(chunk);
    lock.lock();
    if (++job->done_ < job->chunks_) continue;
    job->end_ = Clock::now();
    jobEnded_.notify_all();
  }
}

}  // namespace halfsilver
