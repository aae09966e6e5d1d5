// Results on their way from process to process: files that begin with the digest of what follows. One that
// is not whole, as after a failure of power, is none.
#include <mutex>
#include <optional>
#include <thread>

#include <fmt/format.h>

#include <sim/cluster/handout.hpp>
#include <sim/cluster/share.hpp>
#include <sim/input/hash.hpp>
#include <sim/run/batch.hpp>

namespace mckibben::cluster {
namespace {

/// Hands on results in order.
class Gathering {
 public:
  using Read = std::function<std::optional<std::string>(std::size_t)>;
  using Take = std::function<void(std::size_t, const std::string&)>;

  Gathering(std::size_t count, Read read, const Take& take)
      : count_(count), read_(std::move(read)), take_(take) {}

  void operator()() {
    const std::lock_guard lock(mutex_);
    for (; next_ < count_; ++next_) {
      const auto bytes = read_(next_);
      if (!bytes) return;
      take_(next_, *bytes);
    }
  }

 private:
  std::size_t count_, next_ = 0;
  Read read_;
  const Take& take_;
  std::mutex mutex_;
};

}  // namespace

void share(Workplace& place, const std::string& stage, std::size_t count, unsigned threads, Needed needed,
           const std::function<std::string(std::size_t)>& job,
           const std::function<void(std::size_t, const std::string&)>& take) {
  const auto file = [&](std::size_t i) { return place.folder() / fmt::format("{}-{}", stage, i); };
  const auto read = [&](std::size_t i) {
    return input::unsealed_bytes(output::read_regular(file(i)).value_or(""));
  };
  Handout handout(place, count, [&](std::size_t i) { return read(i).has_value(); });
  Gathering gather(count, read, take);
  const bool waits = needed == Needed::by_all || place.crew().leads();
  const auto work = [&](std::size_t) {
    while (const auto i = handout.take()) {
      const std::string bytes = job(*i);
      output::write_staged(file(*i), input::sealed_bytes(bytes));
      handout.done(*i);
      if (waits) gather();
    }
  };
  do {
    run::for_each_job(threads == 0 ? std::thread::hardware_concurrency() : threads, threads, work,
                      [](std::size_t) {});
    if (run::interrupted()) throw run::Interrupted();
    if (waits) gather();
  } while (waits && handout.again());
  if (waits) gather();
}

}  // namespace mckibben::cluster
