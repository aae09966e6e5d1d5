// Server and session in their threads, with clients in others: pages, commands and news at once, some of them
// stuck. Built with ThreadSanitizer, it looks at all of them.
#include <atomic>
#include <string>
#include <thread>
#include <vector>

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <sim/live/server.hpp>

#include "says.hpp"
#include "scratch.hpp"

namespace mckibben::live {
namespace {

/// A connection to 127.0.0.1, on which this text is sent at once.
class Client {
 public:
  Client(int port, const std::string& text) : socket_(socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_port = htons(static_cast<std::uint16_t>(port));
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    EXPECT_EQ(connect(socket_, reinterpret_cast<const sockaddr*>(&to), sizeof to), 0);
    EXPECT_EQ(send(socket_, text.data(), text.size(), MSG_NOSIGNAL), static_cast<ssize_t>(text.size()));
  }
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;
  ~Client() { close(socket_); }

  /// What comes until `end` is there, or nothing more comes.
  std::string hear(const std::string& end) const {
    std::string heard;
    char some[4096];
    while (heard.find(end) == std::string::npos) {
      const ssize_t size = recv(socket_, some, sizeof some, 0);
      if (size <= 0) break;
      heard.append(some, static_cast<std::size_t>(size));
    }
    return heard;
  }

 private:
  int socket_;
};

TEST(LiveServer, ManyClientsAtOnceAreServedAndStuckOnesKeepNothing) {
  const Scratch scratch;
  const plant::Rig rig;
  const auto say = [](const std::string&) {};
  Host host(rig, 16.0, DataSets(scratch / "out", "a session", say));
  {
    const Server server(host, page_of("thesis", rig, Session(rig, 16.0)), 0);
    const std::string address = server.address();
    const auto colon = address.rfind(':'), slash = address.find('/', colon);
    const int port = std::stoi(address.substr(colon + 1, slash - colon - 1));
    const std::string path = address.substr(slash), host_line = "\r\nHost: 127.0.0.1:" + std::to_string(port);
    const auto get = [&](const std::string& what) {
      return "GET " + path + what + " HTTP/1.1" + host_line + "\r\n\r\n";
    };
    const auto post = [&](const std::string& text) {
      return "POST " + path + "do HTTP/1.1" + host_line +
             "\r\nConnection: close\r\nContent-Type: application/json" +
             "\r\nContent-Length: " + std::to_string(text.size()) + "\r\n\r\n" + text;
    };
    const Client half(port, "GET / HTTP/1.1\r\nX: "), silent(port, ""), unread(port, get("news"));
    EXPECT_TRUE(holds(Client(port, post(R"({"do":"record","from_rest":true})")).hear("}"), "200 OK",
                      R"("refused":"")"));
    std::atomic<int> fine = 0;
    std::vector<std::thread> clients;
    for (int i = 0; i < 4; ++i)
      clients.emplace_back([&, i] {
        const Client watcher(port, get("news"));
        for (int k = 0; k < 5; ++k) {
          const std::string command = R"({"do":"command","to":)" + std::to_string(5 + i + k) + "}";
          if (Client(port, post(command)).hear("}").find(R"("refused":"")") != std::string::npos) ++fine;
          if (Client(port, get("")).hear("</html>").find("200 OK") != std::string::npos) ++fine;
        }
        if (watcher.hear("]]").find("data: {") != std::string::npos) ++fine;
      });
    for (std::thread& client : clients) client.join();
    EXPECT_EQ(fine, 4 * 11);
    EXPECT_TRUE(holds(Client(port, get("news")).hear("[1.5,"), "[1.5,"));  // rows enough for a run
    host.finish(say);
  }
  EXPECT_TRUE(std::filesystem::exists(scratch / "out/r01.csv"));
}

}  // namespace
}  // namespace mckibben::live
