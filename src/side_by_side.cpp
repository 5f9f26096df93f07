#include "src/side_by_side.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <numeric>
#include <thread>

#include "common/core/clock.hpp"

namespace galet {

namespace {

/// Adds up what the pieces have done, for one progress line.
class SharedProgress {
 public:
  SharedProgress(const SideBySideOptions& options, const std::vector<double>& costs)
      : options_(options), costs_(costs), shares_(costs.size(), 0.0) {
    total_ = std::accumulate(costs_.begin(), costs_.end(), 0.0);
  }

  void update(std::size_t piece, double share) {
    const std::lock_guard lock(mutex_);
    shares_[piece] = share;
    const double now = wall_seconds();
    if (!options_.progress || !(total_ > 0) || now - reported_ < 0.2) return;
    reported_ = now;
    const double done = std::inner_product(costs_.begin(), costs_.end(), shares_.begin(), 0.0) / total_;
    options_.progress(done, done > 0 ? (now - start_) * (1 - done) / done : 0);
  }

 private:
  const SideBySideOptions& options_;
  const std::vector<double>& costs_;
  std::vector<double> shares_;
  double total_ = 0, start_ = wall_seconds(), reported_ = 0;
  std::mutex mutex_;
};

}  // namespace

void run_side_by_side(const SideBySideOptions& options, const std::vector<double>& costs,
                      const std::function<void(std::size_t, const WorkControl&)>& work) {
  if (costs.empty()) return;
  std::vector<std::size_t> order(costs.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return costs[a] > costs[b]; });
  std::vector<std::exception_ptr> errors(costs.size());
  SharedProgress progress(options, costs);
  std::atomic<std::size_t> next = 0;
  std::atomic<bool> abandoned = false;

  const auto worker = [&] {
    for (std::size_t k = next++; k < order.size(); k = next++) {
      const std::size_t piece = order[k];
      WorkControl control;
      control.stop = [&] { return abandoned || (options.stop && options.stop()); };
      control.progress = [&progress, piece](double share) { progress.update(piece, share); };
      try {
        work(piece, control);
      } catch (...) {
        errors[piece] = std::current_exception();
        abandoned = true;
      }
      progress.update(piece, 1);
    }
  };
  std::vector<std::jthread> workers;
  const int count = std::clamp(options.jobs, 1, static_cast<int>(costs.size()));
  for (int k = 0; k < count; ++k) workers.emplace_back(worker);
  workers.clear();  // joins
  for (const std::exception_ptr& error : errors)
    if (error) std::rethrow_exception(error);
}

}  // namespace galet
