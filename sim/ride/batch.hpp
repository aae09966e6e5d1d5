// Many simulations at once in the lanes of an engine's batch, each with step sizes and instants of its own.
// The result of one does not depend on the others, to the bit.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <plant/solver.hpp>
#include <sim/engine/batch.hpp>
#include <sim/engine/failure.hpp>
#include <sim/ride/rider.hpp>

namespace mckibben::ride {

/// One simulation: of a rig, or of several under the same drive, whose differences are sensitivities.
class BatchItem {
 public:
  BatchItem() = default;
  BatchItem(const BatchItem&) = delete;
  BatchItem& operator=(const BatchItem&) = delete;
  virtual ~BatchItem() = default;

  /// 1 to engine::Batch::width, which have been started and stay where they are.
  virtual std::span<Rider> riders() = 0;
  /// At an instant: all have held what acts until the next one; false if this was the last. May throw.
  virtual bool go_on() = 0;
  /// This was the last, or it can go no further: then why.
  virtual void end(const engine::Counters& solver, const engine::NumericalFailure* failure) = 0;
};

/// How an item is simulated: what items of one batch have in common.
struct BatchKey {
  bool in_lanes = false;  ///< or alone
  engine::BatchShape shape{};
  solver::Method method{};
  double tolerance = 0.0;
  plant::GivenPressure given{}, opposite_given{};
  bool length_is_given = false;
  engine::Kind kind{};

  auto operator<=>(const BatchKey&) const = default;
};

/// Of an item's riders. Not in lanes are exact stick and slip, CVODE, a ledger of two muscles or of gas with
/// a temperature.
BatchKey batch_key(std::span<const Rider> riders, const Drive& drive, const solver::Settings& settings,
                   bool keep_ledger = false);

/// An item alone: each of its rigs has step sizes of its own.
class Alone {
 public:
  /// `pace`, `before`: where it has been in a batch until now.
  Alone(std::span<const Rider> riders, const BatchKey& key, const engine::Pace* pace = nullptr,
        const engine::Counters& before = {});

  /// As long as the item goes on. `holds`: it has held what acts until the next instant.
  void run(BatchItem& item, bool holds = false);

  /// Of the first rig.
  engine::Pace pace() const { return integrators_.front()->pace(); }

 private:
  std::vector<std::unique_ptr<engine::Integrator>> integrators_;
  engine::Counters before_;
};

/// How an item of a batch is carried, beside what its riders are: one that is submitted with it goes on to
/// the same bits.
struct Carried {
  engine::Pace pace{};
  bool alone = false;  ///< it was evicted
};

class Batch {
 public:
  /// `lanes`: at most engine::Batch::most_lanes. `resumable`: items that end keep their lanes and are asked
  /// again in the next run.
  Batch(BatchKey key, std::size_t lanes, bool resumable = false);

  /// False if there are too few free lanes.
  bool submit(const std::shared_ptr<BatchItem>& item, const Carried& from = {});
  /// Of a resumable batch, between two runs; none: the item is not in it.
  std::optional<Carried> carried(const BatchItem& item) const;

  /// Simulates all items, and those that `next` gives until it gives none any more (null). Throws what items
  /// throw.
  using Next = std::function<std::shared_ptr<BatchItem>()>;
  void run(const Next& next = [] { return nullptr; });

 private:
  struct Slot {
    std::shared_ptr<BatchItem> item;
    std::unique_ptr<Alone> alone;  ///< of one that was evicted
  };

  void fill(const Next& next);
  void arrive(std::size_t slot, bool arrived, const Next& next);
  void go_on(std::size_t slot);
  void advance(std::size_t slot);
  void evict(std::size_t slot, bool stiff);
  void leave(std::size_t slot);

  BatchKey key_;
  bool resumable_;
  std::unique_ptr<engine::Batch> lanes_;
  std::array<Slot, engine::Batch::most_lanes> slots_{};
  std::shared_ptr<BatchItem> waiting_;  // for lanes to become free
};

}  // namespace mckibben::ride
