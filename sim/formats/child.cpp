// A child process that hands its result over in a file in memory; see the header.
#include <cerrno>
#include <exception>
#include <new>
#include <string>
#include <system_error>

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <sim/formats/child.hpp>
#include <sim/formats/memory_file.hpp>
#include <sim/formats/table.hpp>

namespace mckibben::formats {
namespace {

enum Ending { whole = 0, refused = 1, broken = 2, no_machine = 3 };

constexpr rlim_t longest_s = 20;  // of computing: a damaged file can also make for an endless loop

/// Never returns: nothing of the parent's that would run at exit may run here.
[[noreturn]] void be_the_child(const std::function<std::string()>& work, MemoryFile& result) {
  const rlimit no_core{0, 0}, time{longest_s, longest_s};
  setrlimit(RLIMIT_CORE, &no_core);
  setrlimit(RLIMIT_CPU, &time);
  const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
  dup2(nowhere, STDOUT_FILENO);  // what is said about a crash says nothing to a user
  dup2(nowhere, STDERR_FILENO);
  Ending ending = whole;
  try {
    try {
      result.append(work());
    } catch (const BadFile& bad) {
      result.append(bad.what());
      ending = refused;
    } catch (const std::system_error& error) {
      result.append(std::to_string(error.code().value()));
      ending = no_machine;
    } catch (const std::bad_alloc&) {
      result.append(std::to_string(ENOMEM));
      ending = no_machine;
    }
  } catch (const std::exception&) {
    ending = broken;
  }
  _exit(ending);
}

}  // namespace

std::string in_child(const std::function<std::string()>& work) {
  MemoryFile result;
  const pid_t child = fork();
  if (child < 0) throw std::system_error(errno, std::generic_category(), "a child process");
  if (child == 0) be_the_child(work, result);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFEXITED(status) && WEXITSTATUS(status) == whole) return result.bytes();
  if (WIFEXITED(status) && WEXITSTATUS(status) == refused) throw BadFile(result.bytes());
  if (WIFEXITED(status) && WEXITSTATUS(status) == no_machine)
    throw std::system_error(std::stoi(result.bytes()), std::generic_category(), "a child process");
  throw BadFile("the file is damaged: it cannot be read");
}

}  // namespace mckibben::formats
