// The folder in which the processes of a crew meet, on a file system that all of them see. Who works on what
// is said by locks on bytes of one file: byte n for piece of work n. The system lets go of a lock when its
// holder ends, however it ends, so what a dead process had claimed is free again.
//
//   FOLDER/call       which call of the launcher, and of what; written when rank 0 has prepared everything
//          claims     nothing in it; locks on its bytes
//          rank-N     rank N was here: its host and process
//          STAGE-N    the result of a piece of work (share.hpp)
//
// A piece of work gives the same bytes whoever does it, so it would not matter if two did.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include <sim/cluster/crew.hpp>
#include <sim/output/file.hpp>

namespace mckibben::cluster {

/// What keeps a crew from working together; for the user.
class CannotMeet : public output::CannotWrite {
 public:
  using CannotWrite::CannotWrite;
};

class Workplace {
 public:
  /// Prepares the meeting at `folder`. A process that is alone needs none, unless an earlier crew left one.
  /// `say` hears whenever `patience` has gone by, and for whom. Throws CannotMeet if processes of an earlier
  /// call are still at work there; CannotWrite.
  Workplace(const std::filesystem::path& folder, Crew crew,
            std::function<void(const std::string&)> say = nullptr,
            std::chrono::milliseconds patience = std::chrono::minutes(1));
  Workplace(const Workplace&) = delete;
  Workplace& operator=(const Workplace&) = delete;
  ~Workplace();

  /// A wait for others, in a loop: `rest` is a moment. Throws Interrupted.
  class Wait {
   public:
    Wait(const Workplace& place, std::string what);
    void rest();

   private:
    const Workplace& place_;
    std::string what_;
    std::chrono::steady_clock::time_point began_, next_;
  };

  /// Rank 0: everything is prepared for the job that `key` stands for; results of another are removed. Others
  /// wait for that. Throws CannotMeet if rank 0 is not there, or does something else; Interrupted.
  void begin(const std::string& key);

  /// Claims a piece of work; false if somebody holds it.
  bool claim(std::uint64_t number);
  void release(std::uint64_t number);
  /// Numbers of its own for another stage of the job, for as many pieces as it may have.
  std::uint64_t next_stage() { return stage_++ << 40U; }

  /// Rank 0, once everything is done: nobody can claim anything more.
  void close();
  /// Rank 0: the others have been here and have gone, or will not come; the folder goes.
  void leave();

  /// Whether anybody else is, or was, at work here.
  bool used() const { return used_; }
  const std::filesystem::path& folder() const { return folder_; }
  const Crew& crew() const { return crew_; }

 private:
  enum class Kind { shared, exclusive, none };
  bool lock(Kind kind, std::uint64_t first, std::uint64_t length) const;
  bool is_free(std::uint64_t byte) const;
  bool joins() const;
  void wait_for_leader();
  void sign() const;
  std::string who_is_there() const;
  void remove() const;

  std::filesystem::path folder_;
  Crew crew_;
  std::function<void(const std::string&)> say_;
  std::chrono::milliseconds patience_;
  bool used_, begun_ = false;
  std::uint64_t stage_ = 0;
  output::Descriptor claims_;
};

}  // namespace mckibben::cluster
