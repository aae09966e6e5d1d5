// Standard streams; see the header. {fmt} throws where a stream cannot be written, and stderr may be closed,
// full or a pipe that nobody reads; glibc lets it be another stream ("Standard Streams" in its manual).
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <tuple>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <sim/cli/streams.hpp>
#include <sim/output/folder.hpp>

namespace mckibben::cli {
namespace {

int print_error = 0;  // errno of the first failure
bool quiet = false;

/// As far as it goes.
ssize_t write_to_stderr(void*, const char* text, std::size_t size) {
  if (!quiet) std::ignore = output::write_all(STDERR_FILENO, {text, size});
  return static_cast<ssize_t>(size);
}

/// Taken in the direction in which it is not used: using it still fails, as it should.
void take_if_closed(int descriptor, int direction) {
  if (fcntl(descriptor, F_GETFD) < 0 && errno == EBADF) std::ignore = open("/dev/null", direction);
}

}  // namespace

void prepare_streams() {
  take_if_closed(STDIN_FILENO, O_WRONLY);
  take_if_closed(STDOUT_FILENO, O_RDONLY);
  take_if_closed(STDERR_FILENO, O_RDONLY);
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  cookie_io_functions_t functions{};
  functions.write = write_to_stderr;
  if (std::FILE* patient = fopencookie(nullptr, "w", functions)) {
    std::setvbuf(patient, nullptr, _IONBF, 0);
    stderr = patient;
  }
}

void keep_quiet() {
  quiet = true;
}

void tell_anyway(const std::string& text) {
  std::ignore = output::write_all(STDERR_FILENO, text);
}

void print(const std::string& text) {
  if (quiet) return;
  const bool whole = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
  if ((!whole || std::fflush(stdout) != 0) && print_error == 0) print_error = errno;
}

void check_printed() {
  if (print_error != 0 && print_error != EPIPE)
    throw output::CannotWrite(fmt::format("cannot write to standard output: {}", std::strerror(print_error)));
}

}  // namespace mckibben::cli
