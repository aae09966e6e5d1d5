// A controller in a process of its own: a crash, an exit, a hang, spoilt memory are not the loop's. That
// process guards the output as well: if the loop's process ends, by whatever signal, or is suspended, it
// vents.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <sys/types.h>

#include <controllers/controller.hpp>
#include <plant/rig.hpp>

namespace mckibben::bench {

/// What its process is told besides.
struct Hosting {
  const plant::Rig& rig;
  std::int64_t first_tick;     ///< of the controller; until then it settles under its first command
  double longest_silence_s;    ///< between two readings; then the loop is taken for dead
  std::function<void()> vent;  ///< by the output as this process has it
};

class Hosted {
 public:
  /// Called again and again while an answer is waited for; throws to give up.
  using Meanwhile = std::function<void()>;

  /// Starts the process, whose first answer is the command while the rig settles.
  Hosted(std::unique_ptr<controllers::Controller> controller, const Hosting& hosting);
  Hosted(const Hosted&) = delete;
  Hosted& operator=(const Hosted&) = delete;
  /// Ends the process; what has not ended 1.5 s later is killed.
  ~Hosted();

  void show(const controllers::Reading& reading);
  /// The command. Throws ControllerFailure: what the controller threw, or how its process ended.
  double answer(const Meanwhile& meanwhile);
  /// What it found out; the process ends. Throws as `answer`.
  std::vector<controllers::Finding> end(const Meanwhile& meanwhile);

 private:
  std::string heard(const Meanwhile& meanwhile);
  bool gone_within(double time_s);
  std::string how_it_ended() const;

  pid_t process_ = -1;
  int line_ = -1, status_ = 0;
};

}  // namespace mckibben::bench
