// The page and its session over HTTP, for this machine alone: bound to 127.0.0.1, behind a token in the
// address that only who started the program knows. Requests that another site makes a browser send are
// refused: by their token, by the host they name (DNS rebinding), and by where they say that they come from.
#pragma once

#include <memory>
#include <string>

#include <sim/live/host.hpp>
#include <sim/live/page.hpp>

namespace mckibben::live {

class Server {
 public:
  /// Serves in threads of its own from here on. `port` 0: any that is free. Throws std::system_error if the
  /// port cannot be had.
  Server(Host& host, Page page, int port);
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;
  ~Server();

  /// http://127.0.0.1:PORT/TOKEN/
  std::string address() const;

 private:
  struct Inside;
  std::unique_ptr<Inside> inside_;
};

/// 128 bits by chance, in hexadecimal digits. Throws std::runtime_error if the machine has none.
std::string new_token();

}  // namespace mckibben::live
