// A fork and a pipe; see the header.
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <exception>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <sim/formats/isolated.hpp>
#include <sim/formats/table.hpp>

namespace mckibben::formats {
namespace {

constexpr char done = 'd', refused = 'r';
constexpr rlim_t longest_s = 100;  // of the processor; a hundred megabytes take seconds

std::string packed(const std::vector<std::string>& parts) {
  std::string bytes(1, done);
  for (const std::string& part : parts) {
    const std::size_t size = part.size();
    bytes.append(reinterpret_cast<const char*>(&size), sizeof size).append(part);
  }
  return bytes;
}

std::vector<std::string> unpacked(const std::string& bytes) {
  std::vector<std::string> parts;
  for (std::size_t at = 1, size = 0; at < bytes.size(); at += sizeof size + size) {
    std::memcpy(&size, bytes.data() + at, sizeof size);
    parts.push_back(bytes.substr(at + sizeof size, size));
  }
  return parts;
}

[[noreturn]] void live_as_reader(int pipe, const std::function<std::vector<std::string>()>& work) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  const rlimit none{0, 0}, patience{longest_s, longest_s};
  setrlimit(RLIMIT_CORE, &none);
  setrlimit(RLIMIT_CPU, &patience);
  std::string bytes;
  try {
    bytes = packed(work());
  } catch (const std::exception& why) {
    bytes = refused + std::string(why.what());
  }
  for (std::size_t sent = 0; sent < bytes.size();) {
    const ssize_t count = write(pipe, bytes.data() + sent, bytes.size() - sent);
    if (count < 0 && errno != EINTR) break;
    sent += count > 0 ? static_cast<std::size_t>(count) : 0;
  }
  _exit(0);
}

}  // namespace

std::vector<std::string> isolated(const std::function<std::vector<std::string>()>& work) {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0)
    throw BadFile(fmt::format("it cannot be read: {}", std::strerror(errno)));
  const pid_t process = fork();
  const int error = errno;
  if (process == 0) live_as_reader(ends[1], work);
  close(ends[1]);
  std::string bytes;
  std::array<char, 1U << 16U> block;
  for (ssize_t count = 1; process > 0 && count != 0;) {
    count = read(ends[0], block.data(), block.size());
    if (count > 0) bytes.append(block.data(), static_cast<std::size_t>(count));
  }
  close(ends[0]);
  if (process < 0) throw BadFile(fmt::format("it cannot be read: {}", std::strerror(error)));
  int status = 0;
  while (waitpid(process, &status, 0) < 0 && errno == EINTR) continue;
  if (!bytes.empty() && bytes.front() == refused) throw BadFile(bytes.substr(1));
  if (status != 0 || bytes.empty())
    throw BadFile(fmt::format("it is damaged: the library that reads it ended by {}",
                              WIFSIGNALED(status) ? strsignal(WTERMSIG(status)) : "itself"));
  return unpacked(bytes);
}

}  // namespace mckibben::formats
