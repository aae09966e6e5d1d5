// Locks of open files (F_OFD_SETLK of Linux), and who waits for whom; see the header.
#include <cerrno>
#include <chrono>
#include <climits>
#include <cstring>
#include <fstream>
#include <iterator>
#include <optional>
#include <thread>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <sim/cluster/workplace.hpp>
#include <sim/output/folder.hpp>
#include <sim/output/manifest.hpp>
#include <sim/run/batch.hpp>

namespace mckibben::cluster {
namespace fs = std::filesystem;
namespace {

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

// Bytes beyond all pieces of work: held by rank 0 while it is there, and by all others.
constexpr std::uint64_t leader_byte = std::uint64_t{1} << 62U, others_byte = leader_byte + 1;
constexpr std::uint64_t work_bytes = leader_byte;

constexpr const char* call_file = "call";
constexpr const char* claims_file = "claims";

constexpr auto longest_wait = 60s;      // for rank 0 to appear
constexpr auto longest_farewell = 20s;  // for others that are late, or slow to go
constexpr auto pause = 20ms;

std::string rank_file(int rank) {
  return fmt::format("rank-{}", rank);
}

/// Whether a file is one of those that a crew leaves.
bool is_ours(const fs::path& path) {
  const std::string name = path.filename().string();
  const auto stem = name.find_first_not_of("abcdefghijklmnopqrstuvwxyz");
  return name == call_file || name == claims_file || output::is_temporary(path) ||
         (stem != std::string::npos && stem > 0 && name[stem] == '-' && name.size() > stem + 1 &&
          name.find_first_not_of("0123456789", stem + 1) == std::string::npos);
}

struct flock range_of(std::uint64_t first, std::uint64_t length) {
  struct flock range {};
  range.l_type = F_WRLCK;
  range.l_whence = SEEK_SET;
  range.l_start = static_cast<off_t>(first);
  range.l_len = static_cast<off_t>(length);
  return range;
}

void rest() {
  if (run::interrupted()) throw run::Interrupted();
  std::this_thread::sleep_for(pause);
}

std::string host() {
  char name[HOST_NAME_MAX + 1]{};
  gethostname(name, HOST_NAME_MAX);
  return name;
}

/// Its letter in /proc, T if it is stopped; none if it has ended.
std::optional<char> state_of(const std::string& process) {
  std::ifstream file("/proc/" + process + "/stat");
  const std::string said(std::istreambuf_iterator<char>(file), {});
  const auto name_end = said.rfind(')');
  return name_end + 2 < said.size() ? std::optional(said[name_end + 2]) : std::nullopt;
}

}  // namespace

Workplace::Workplace(const fs::path& folder, Crew crew, std::function<void(const std::string&)> say,
                     std::chrono::milliseconds patience)
    : folder_(output::result_path(folder)),
      crew_(std::move(crew)),
      say_(std::move(say)),
      patience_(patience),
      used_(!crew_.alone() || fs::exists(folder_)) {
  if (!used_ || !crew_.leads()) return;
  std::error_code error;
  fs::create_directories(folder_, error);
  for (const auto& entry : fs::directory_iterator(folder_, error))
    if (!is_ours(entry.path()))
      output::cannot_write(folder_, fmt::format("{} in it is not of this program; please move it away",
                                                entry.path().filename().string()));
  claims_ = output::open_file(folder_ / claims_file, O_RDWR | O_CREAT);
  if (error || !claims_) output::cannot_write(folder_, error ? error.value() : errno);
  if (!lock(Kind::exclusive, leader_byte, 2))
    throw CannotMeet(fmt::format(
        "processes of an earlier call are still at work in {}; end them first, or wait", folder_.string()));
  lock(Kind::none, others_byte, 1);
}

Workplace::~Workplace() {
  if (!used_ || !crew_.leads() || begun_) return;
  remove();
}

bool Workplace::lock(Kind kind, std::uint64_t first, std::uint64_t length) const {
  struct flock range = range_of(first, length);
  range.l_type = static_cast<short>(kind == Kind::none ? F_UNLCK : kind == Kind::shared ? F_RDLCK : F_WRLCK);
  if (fcntl(claims_.number(), F_OFD_SETLK, &range) == 0) return true;
  if (errno != EAGAIN && errno != EACCES)
    output::cannot_write(folder_, fmt::format("its file system has no locks ({}); give an --out elsewhere",
                                              std::strerror(errno)));
  return false;
}

bool Workplace::is_free(std::uint64_t byte) const {
  struct flock range = range_of(byte, 1);
  return fcntl(claims_.number(), F_OFD_GETLK, &range) == 0 && range.l_type == F_UNLCK;
}

/// Whether rank 0 of this call has begun; then this process is at work as well.
bool Workplace::joins() const {
  const auto opened = [&] {
    const auto said = output::read_regular(folder_ / call_file);
    return said && said->starts_with(crew_.call + "\n") && !is_free(leader_byte);
  };
  if (!opened() || !lock(Kind::shared, others_byte, 1)) return false;
  if (opened()) return true;
  lock(Kind::none, others_byte, 1);
  return false;
}

void Workplace::wait_for_leader() {
  const auto began = Clock::now();
  Wait wait(*this, "rank 0 to begin");
  for (bool seen = false;; wait.rest()) {
    claims_ = output::open_file(folder_ / claims_file, O_RDWR);
    if (claims_ && joins()) return;
    const bool there = claims_ && !is_free(leader_byte);
    if (seen && !there) throw CannotMeet("rank 0 has ended before it began");
    seen = seen || there;
    if (!seen && Clock::now() - began > longest_wait)
      throw CannotMeet(
          fmt::format("rank 0 was not met in {} for a minute; all ranks must see the same folder there",
                      folder_.string()));
  }
}

void Workplace::begin(const std::string& key) {
  begun_ = true;
  if (!used_) return;
  const std::string said = fmt::format("{}\n{}\n", crew_.call, key);
  if (!crew_.leads()) {
    wait_for_leader();
    sign();
    if (output::read_regular(folder_ / call_file) != said)
      throw CannotMeet("rank 0 has read other input, or is another version of the program");
    return;
  }
  const auto earlier = output::read_regular(folder_ / call_file);
  const bool same = earlier && earlier->ends_with(fmt::format("\n{}\n", key));
  for (const auto& entry : fs::directory_iterator(folder_)) {
    const std::string name = entry.path().filename().string();
    if (name != claims_file && (!same || name.starts_with("rank-") || name == call_file))
      fs::remove(entry.path());
  }
  sign();
  output::write_staged(folder_ / call_file, said);
}

void Workplace::sign() const {
  output::write_staged(folder_ / rank_file(crew_.rank), fmt::format("{} {}", host(), getpid()));
}

std::string Workplace::who_is_there() const {
  std::string all;
  for (int rank = 0; rank < crew_.size; ++rank) {
    const std::string said = output::read_regular(folder_ / rank_file(rank)).value_or("");
    const auto blank = said.rfind(' ');
    if (rank == crew_.rank || blank == std::string::npos) continue;
    const std::string place = said.substr(0, blank), process = said.substr(blank + 1);
    const auto state = state_of(process);
    if (place == host() && !state) continue;
    const bool stopped = place == host() && (state == 'T' || state == 't');
    all +=
        fmt::format("; rank {} (process {}{}){}", rank, process, place == host() ? "" : " on " + place,
                    stopped ? fmt::format(" is stopped: kill -CONT {0} lets it go on, kill -KILL {0} leaves "
                                          "its work to the others",
                                          process)
                            : "");
  }
  return all;
}

Workplace::Wait::Wait(const Workplace& place, std::string what)
    : place_(place), what_(std::move(what)), began_(Clock::now()), next_(began_ + place.patience_) {}

void Workplace::Wait::rest() {
  cluster::rest();
  const auto now = Clock::now();
  if (now < next_ || !place_.say_) return;
  next_ = now + (now - began_);
  place_.say_(fmt::format("waiting for {} since {} s{}", what_,
                          std::chrono::duration_cast<std::chrono::seconds>(now - began_).count(),
                          place_.who_is_there()));
}

bool Workplace::claim(std::uint64_t number) {
  return !claims_ || lock(Kind::exclusive, number, 1);
}

void Workplace::release(std::uint64_t number) {
  if (claims_) lock(Kind::none, number, 1);
}

void Workplace::close() {
  Wait wait(*this, "others to let go of what is done");
  if (claims_)
    while (!lock(Kind::exclusive, 0, work_bytes)) wait.rest();
}

void Workplace::leave() {
  if (!used_) return;
  const auto began = Clock::now();
  const auto late = [&] { return Clock::now() - began < longest_farewell; };
  for (int rank = 1; rank < crew_.size; ++rank)
    while (!fs::exists(folder_ / rank_file(rank)) && late()) rest();
  while (!is_free(others_byte) && late()) rest();  // who is here may still read what was made
  remove();
}

void Workplace::remove() const {
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder_, ignored))
    if (is_ours(entry.path())) fs::remove(entry.path(), ignored);
  fs::remove(folder_, ignored);
}

}  // namespace mckibben::cluster
