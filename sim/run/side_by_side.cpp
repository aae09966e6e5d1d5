// See the header.
#include <algorithm>
#include <deque>
#include <iterator>
#include <list>
#include <map>
#include <thread>
#include <utility>

#include <sim/run/batch.hpp>
#include <sim/run/side_by_side.hpp>

namespace mckibben::run {
namespace {

/// What one thread does: takes errands, and carries those of one class side by side.
class Carrier {
 public:
  Carrier(const Take& take, const Prepare& prepare, std::size_t places)
      : take_(take), prepare_(prepare), places_(places) {}

  void operator()() {
    while (fetch()) {
      const ride::ConvoyClass now = waiting_.begin()->first;
      ride::ride_in_convoy([&] { return next(now); }, now, places_);
      on_board_.clear();
    }
  }

 private:
  using Begin = std::function<std::unique_ptr<Errand>()>;

  /// Takes an errand; those that go by themselves are done at once. False if there is none left.
  bool fetch() {
    while (waiting_.empty()) {
      const auto index = take_();
      if (!index) return false;
      if (auto prepared = prepare_(*index))
        waiting_[std::move(prepared->in)].push_back(std::move(prepared->begin));
    }
    return true;
  }

  ride::Party* next(const ride::ConvoyClass& now) {
    std::erase_if(on_board_, [](const auto& errand) { return errand->is_done(); });
    for (;;) {
      if (const auto mine = waiting_.find(now); mine != waiting_.end()) {
        on_board_.push_back(mine->second.front()());
        mine->second.pop_front();
        if (mine->second.empty()) waiting_.erase(mine);
        return on_board_.back().get();
      }
      auto others = std::exchange(waiting_, {});  // they come when these are through
      const bool more = fetch();
      for (auto& [other, errands] : others)
        std::move(errands.begin(), errands.end(), std::back_inserter(waiting_[other]));
      if (!more) return nullptr;
    }
  }

  const Take& take_;
  const Prepare& prepare_;
  std::size_t places_;
  std::map<ride::ConvoyClass, std::deque<Begin>> waiting_;
  std::list<std::unique_ptr<Errand>> on_board_;
};

}  // namespace

void do_all(const Take& take, std::size_t rigs, unsigned threads, const Prepare& prepare) {
  using engine::Convoy;
  const std::size_t carriers =
      std::min<std::size_t>(rigs, threads == 0 ? std::max(1u, std::thread::hardware_concurrency()) : threads);
  const std::size_t places = rigs > carriers * Convoy::wing ? Convoy::places : Convoy::wing;
  for_each_job(
      carriers, threads, [&](std::size_t) { Carrier(take, prepare, places)(); }, [](std::size_t) {});
}

}  // namespace mckibben::run
