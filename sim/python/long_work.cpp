// See the header.
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include <sim/python/long_work.hpp>

namespace mckibben::python {
namespace {

struct Told {
  std::string what;
  std::size_t done = 0, total = 0;
};

class LongWork {
 public:
  LongWork(const py::object& progress, const std::function<void(const run::ProgressHook&)>& work)
      : progress_(progress), work_(work) {}

  void operator()() {
    const py::gil_scoped_release released;
    std::jthread worker([this] { work(); });
    while (!wait())
      if (!refused_) look_around();
    worker.join();
    const py::gil_scoped_acquire acquired;
    if (!refused_) tell();
    if (refused_) throw std::move(*refused_);
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  void work() {
    run::OwnStop stop;
    {
      const std::scoped_lock lock(mutex_);
      stop_ = &stop;
    }
    try {
      work_([this](const std::string& what, std::size_t done, std::size_t total) {
        const std::scoped_lock lock(mutex_);
        news_ = Told{what, done, total};
      });
    } catch (...) {
      failure_ = std::current_exception();
    }
    const std::scoped_lock lock(mutex_);
    stop_ = nullptr;
    ended_ = true;
    changed_.notify_all();
  }

  /// Whether the work has ended; for a moment it is waited for.
  bool wait() {
    constexpr std::chrono::milliseconds moment(40);
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, moment, [this] { return ended_; });
  }

  void look_around() {
    const py::gil_scoped_acquire acquired;
    if (PyErr_CheckSignals() != 0)
      refused_.emplace();
    else
      tell();
    if (!refused_) return;
    const std::scoped_lock lock(mutex_);
    if (stop_ != nullptr) stop_->ask();
  }

  void tell() {
    std::optional<Told> news;
    {
      const std::scoped_lock lock(mutex_);
      news.swap(news_);
    }
    if (!news || progress_.is_none()) return;
    try {
      progress_(news->what, news->done, news->total);
    } catch (py::error_already_set& raised) {
      refused_.emplace(std::move(raised));
    }
  }

  const py::object& progress_;
  const std::function<void(const run::ProgressHook&)>& work_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<Told> news_;
  run::OwnStop* stop_ = nullptr;  ///< while the work goes on
  bool ended_ = false;
  std::exception_ptr failure_;
  std::optional<py::error_already_set> refused_;  ///< Ctrl-C, or what the one who is told raised
};

}  // namespace

void do_long(const py::object& progress, const std::function<void(const run::ProgressHook&)>& work) {
  LongWork(progress, work)();
}

}  // namespace mckibben::python
