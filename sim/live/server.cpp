// With cpp-httplib; see the header. No other file names it.
#include <array>
#include <cerrno>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <thread>
#include <utility>

#include <fmt/format.h>
#include <httplib.h>
#include <openssl/crypto.h>
#include <openssl/rand.h>

#include <sim/input/fields_json.hpp>
#include <sim/live/server.hpp>

namespace mckibben::live {
namespace {

constexpr const char* this_machine = "127.0.0.1";
constexpr std::size_t most_bytes = 4096;      // of a command
constexpr std::size_t most_connections = 48;  // each has a thread
constexpr std::size_t most_watchers = 12;     // of them hold theirs
constexpr const char* only_from_here =
    "default-src 'none'; script-src 'self'; style-src 'self'; connect-src 'self'; img-src data:; "
    "base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

/// As long as the other, in a time that does not tell where they differ.
bool is_same(std::string_view a, std::string_view b) {
  return a.size() == b.size() && CRYPTO_memcmp(a.data(), b.data(), a.size()) == 0;
}

/// Whoever listens at the port already keeps it: no SO_REUSEPORT, which httplib would set.
void keep_port(socket_t socket) {
  const int yes = 1;
  setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
}

}  // namespace

struct Server::Inside {
  Inside(Host& with, Page shown) : host(with), page(std::move(shown)), token(new_token()) {}

  Host& host;
  Page page;
  std::string token;
  int port = 0;
  std::atomic<std::size_t> watchers{0};
  std::atomic<bool> stop{false};
  httplib::Server http;
  std::thread thread;

  bool is_ours(std::string_view address) const {
    return address == fmt::format("{}:{}", this_machine, port) ||
           address == fmt::format("localhost:{}", port);
  }

  /// Why a request is refused; empty if it is not.
  std::string refusal(const httplib::Request& request) const {
    if (!is_ours(request.get_header_value("Host"))) return "this is not the address that the program printed";
    const std::string origin = request.get_header_value("Origin");
    if (!origin.empty() && !(origin.starts_with("http://") && is_ours(std::string_view(origin).substr(7))))
      return "another site asked for it";
    const std::string site = request.get_header_value("Sec-Fetch-Site");
    if (!site.empty() && site != "same-origin" && site != "none") return "another site asked for it";
    const std::string_view path = request.path;
    const std::size_t end = path.find('/', 1);
    if (end == std::string_view::npos || !is_same(path.substr(1, end - 1), token))
      return "the address lacks the token; take the whole address that the program printed";
    return "";
  }

  void give(const char* name, const char* type, const std::string& text) {
    http.Get("/[0-9a-f]+/" + std::string(name),
             [type, &text](const httplib::Request&, httplib::Response& answer) {
               answer.set_content(text, type);
             });
  }

  void obey(const httplib::Request& request, httplib::Response& answer) {
    std::string why;
    if (request.get_header_value("Content-Type") != "application/json") {
      why = "a command is of the type application/json";
    } else {
      try {
        why = host.obey(read_command(request.body));
      } catch (const std::invalid_argument& refused) {
        why = refused.what();
      }
    }
    answer.status = why.empty() ? 200 : 400;
    answer.set_content(
        input::Json{{"refused", why}}.dump(-1, ' ', true, input::Json::error_handler_t::replace),
        "application/json");
  }

  /// Server-sent events, for as long as the page listens.
  void watch(httplib::Response& answer) {
    if (++watchers > most_watchers) {
      --watchers;
      answer.status = 503;
      answer.set_content("too many pages are open", "text/plain");
      return;
    }
    answer.set_chunked_content_provider(
        "text/event-stream",
        [this, heard = Heard{}](std::size_t, httplib::DataSink& sink) mutable {
          std::string text = host.news(heard, std::chrono::milliseconds(500));
          text = text.empty() ? ": nothing new\n\n" : "data: " + text + "\n\n";
          return !stop && sink.write(text.data(), text.size());
        },
        [this](bool) { --watchers; });
  }

  void prepare() {
    http.new_task_queue = [] { return new httplib::ThreadPool(most_connections); };
    http.set_socket_options(keep_port);
    http.set_tcp_nodelay(true);
    http.set_payload_max_length(most_bytes);
    http.set_keep_alive_max_count(1000);
    http.set_default_headers({{"Content-Security-Policy", only_from_here},
                              {"Cross-Origin-Resource-Policy", "same-origin"},
                              {"Cross-Origin-Opener-Policy", "same-origin"},
                              {"Referrer-Policy", "no-referrer"},
                              {"X-Content-Type-Options", "nosniff"},
                              {"Cache-Control", "no-store"}});
    http.set_pre_routing_handler([this](const httplib::Request& request, httplib::Response& answer) {
      const std::string why = refusal(request);
      if (why.empty()) return httplib::Server::HandlerResponse::Unhandled;
      answer.status = 403;
      answer.set_content("403: " + why + "\n", "text/plain");
      return httplib::Server::HandlerResponse::Handled;
    });
    give("", "text/html; charset=utf-8", page.html);
    give("page.css", "text/css; charset=utf-8", page.css);
    give("page.js", "text/javascript; charset=utf-8", page.js);
    http.Get("/[0-9a-f]+/news", [this](const auto&, auto& answer) { watch(answer); });
    http.Post("/[0-9a-f]+/do",
              [this](const httplib::Request& request, httplib::Response& answer) { obey(request, answer); });
  }
};

Server::Server(Host& host, Page page, int port) : inside_(std::make_unique<Inside>(host, std::move(page))) {
  inside_->prepare();
  errno = 0;
  const bool bound = port == 0 ? (inside_->port = inside_->http.bind_to_any_port(this_machine)) > 0
                               : inside_->http.bind_to_port(this_machine, inside_->port = port);
  if (!bound)
    throw std::system_error(errno != 0 ? errno : EADDRINUSE, std::generic_category(),
                            port == 0 ? "a port of 127.0.0.1" : fmt::format("port {} of 127.0.0.1", port));
  inside_->thread = std::thread([inside = inside_.get()] { inside->http.listen_after_bind(); });
}

Server::~Server() {
  inside_->stop = true;
  while (!inside_->http.is_running()) std::this_thread::yield();  // or it would not hear that it is to stop
  inside_->http.stop();
  inside_->thread.join();
}

std::string Server::address() const {
  return fmt::format("http://{}:{}/{}/", this_machine, inside_->port, inside_->token);
}

std::string new_token() {
  std::array<unsigned char, 16> bytes{};
  if (RAND_bytes(bytes.data(), static_cast<int>(bytes.size())) != 1)
    throw std::runtime_error("this machine gives no random numbers for the page's token");
  std::string token;
  for (const unsigned char byte : bytes) token += fmt::format("{:02x}", byte);
  return token;
}

}  // namespace mckibben::live
