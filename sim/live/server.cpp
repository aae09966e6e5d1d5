// With Boost.Beast, in one thread; see the header. No other file names it. Whatever a client does or leaves
// undone, a deadline ends it: of a request with all of its parts, of an answer, of each piece of news. Debian
// 12's cpp-httplib (0.11.4) has a thread per connection, no deadline for a request, and no limit on heads and
// chunked bodies (CVE-2025-46728, -53628, -53629).
#define BOOST_ASIO_DISABLE_FENCED_BLOCK  // one thread does all the work; ThreadSanitizer knows no fences
#include <array>
#include <chrono>
#include <cstddef>
#include <list>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <thread>
#include <utility>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <fmt/format.h>
#include <openssl/crypto.h>
#include <openssl/rand.h>

#include <sim/input/fields_json.hpp>
#include <sim/live/server.hpp>

namespace mckibben::live {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
using Error = boost::system::error_code;
using Request = http::request<http::string_body>;
using Answer = http::response<http::string_body>;
using asio::ip::tcp;
using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

constexpr const char* this_machine = "127.0.0.1";
constexpr std::size_t most_body = 4096;  // bytes of a command
constexpr std::size_t most_head = 16384;
constexpr std::size_t most_connections = 32;
constexpr std::size_t most_watchers = 12;  // of them
constexpr auto longest_request = 10s;      // from the end of the last answer, so that idle ones end, too
constexpr auto longest_answer = 10s;
constexpr auto longest_farewell = 1s;
constexpr auto longest_silence = 500ms;  // then a watcher hears that there is nothing new
constexpr auto pause = 10ms;             // between two looks for news
constexpr const char* only_from_here =
    "default-src 'none'; script-src 'self'; style-src 'self'; connect-src 'self'; img-src data:; "
    "base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

std::string_view as_std(beast::string_view text) {
  return {text.data(), text.size()};
}

/// As long as the other, in a time that does not tell where they differ.
bool is_same(std::string_view a, std::string_view b) {
  return a.size() == b.size() && CRYPTO_memcmp(a.data(), b.data(), a.size()) == 0;
}

[[noreturn]] void cannot_listen(int error, int port) {
  throw std::system_error(error, std::generic_category(),
                          port == 0 ? "a port of 127.0.0.1" : fmt::format("port {} of 127.0.0.1", port));
}

class Connection;

/// What there is to be seen and done here, and who is connected. Of one thread.
struct Site {
  Host& host;
  Page page;
  std::string token;
  int port = 0;
  std::size_t watchers = 0;
  std::list<Connection*> open{};  ///< that may be closed for others, the oldest first

  bool is_ours(std::string_view address) const {
    return address == fmt::format("{}:{}", this_machine, port) ||
           address == fmt::format("localhost:{}", port);
  }

  /// What of a path comes after the token; null where there is none.
  std::optional<std::string_view> behind_token(std::string_view path) const {
    path = path.substr(0, path.find('?'));
    const std::size_t end = path.find('/', 1);
    if (end == std::string_view::npos || !is_same(path.substr(1, end - 1), token)) return std::nullopt;
    return path.substr(end + 1);
  }

  /// Why a request is refused; empty if it is not.
  std::string refusal(const Request& request) const {
    if (!is_ours(as_std(request[http::field::host])))
      return "this is not the address that the program printed";
    const std::string_view origin = as_std(request[http::field::origin]);
    if (!origin.empty() && !(origin.starts_with("http://") && is_ours(origin.substr(7))))
      return "another site sent it";
    const std::string_view site = as_std(request["Sec-Fetch-Site"]);
    if (!site.empty() && site != "same-origin" && site != "none") return "another site sent it";
    if (!behind_token(as_std(request.target())))
      return "the address lacks the token; take the whole address that the program printed";
    return "";
  }

  /// Why what is asked for is not done; empty if it is.
  std::string obey(const Request& request) const {
    if (request[http::field::content_type] != "application/json")
      return "a command is of the type application/json";
    try {
      return host.obey(read_command(request.body()));
    } catch (const std::invalid_argument& refused) {
      return refused.what();
    }
  }
};

Answer answer_of(http::status status, const char* type, std::string text) {
  Answer answer(status, 11);
  answer.set(http::field::content_type, type);
  answer.set("Content-Security-Policy", only_from_here);
  answer.set("Cross-Origin-Resource-Policy", "same-origin");
  answer.set("Cross-Origin-Opener-Policy", "same-origin");
  answer.set("Referrer-Policy", "no-referrer");
  answer.set("X-Content-Type-Options", "nosniff");
  answer.set(http::field::cache_control, "no-store");
  answer.body() = std::move(text);
  return answer;
}

Answer plain(http::status status, const std::string& why) {
  return answer_of(status, "text/plain", fmt::format("{}: {}\n", static_cast<unsigned>(status), why));
}

Answer answer_to(const Request& request, const Site& site) {
  if (const std::string why = site.refusal(request); !why.empty()) return plain(http::status::forbidden, why);
  const std::string_view path = *site.behind_token(as_std(request.target()));
  if (request.method() == http::verb::post && path == "do") {
    const std::string why = site.obey(request);
    return answer_of(
        why.empty() ? http::status::ok : http::status::bad_request, "application/json",
        input::Json{{"refused", why}}.dump(-1, ' ', true, input::Json::error_handler_t::replace));
  }
  if (request.method() == http::verb::get) {
    if (path.empty()) return answer_of(http::status::ok, "text/html; charset=utf-8", site.page.html);
    if (path == "page.css") return answer_of(http::status::ok, "text/css; charset=utf-8", site.page.css);
    if (path == "page.js") return answer_of(http::status::ok, "text/javascript; charset=utf-8", site.page.js);
    if (path == "news" && site.watchers < most_watchers)
      return answer_of(http::status::ok, "text/event-stream", "");
    if (path == "news") return plain(http::status::service_unavailable, "too many pages are open");
  }
  return plain(http::status::not_found, "there is nothing here");
}

/// What a client sent that is no request, or too much of one; null if it has gone, or was too slow.
std::optional<Answer> answer_to(Error error) {
  if (error == http::error::body_limit) return plain(http::status::payload_too_large, "a command is short");
  if (error == http::error::header_limit || error == http::error::buffer_overflow)
    return plain(http::status::request_header_fields_too_large, "the head of a request is short");
  if (error == http::error::end_of_stream || error == http::error::partial_message ||
      error.category() != make_error_code(http::error::bad_method).category())
    return std::nullopt;
  return plain(http::status::bad_request, error.message());
}

/// One client, from request to request. What is under way keeps it.
class Connection : public std::enable_shared_from_this<Connection> {
 public:
  Connection(tcp::socket socket, Site& site)
      : site_(site), stream_(std::move(socket)), timer_(stream_.get_executor()) {
    site_.open.push_back(this);
  }
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;
  ~Connection() {
    site_.open.remove(this);
    if (watches_) --site_.watchers;
  }

  void read() {
    parser_.emplace();
    parser_->header_limit(most_head);
    parser_->body_limit(most_body);
    stream_.expires_after(longest_request);
    http::async_read(stream_, buffer_, *parser_,
                     [self = shared_from_this()](Error error, std::size_t) { self->answer(error); });
  }

  void close() { stream_.close(); }

 private:
  void answer(Error error) {
    std::optional<Answer> answer;
    bool goes_on = false;
    if (error) {
      answer = answer_to(error);
      if (!answer) return;
    } else {
      const Request request = parser_->release();
      try {
        answer = answer_to(request, site_);
      } catch (const std::exception& defect) {
        answer = plain(http::status::internal_server_error, defect.what());
      }
      watches_ = (*answer)[http::field::content_type] == "text/event-stream";
      goes_on = request.keep_alive() && !watches_;
    }
    answer_ = std::move(*answer);
    answer_.keep_alive(goes_on);
    if (!watches_) answer_.prepare_payload();  // news have no length
    stream_.expires_after(longest_answer);
    if (watches_) {
      ++site_.watchers;
      site_.open.remove(this);
    }
    http::async_write(stream_, answer_, [self = shared_from_this(), goes_on](Error failed, std::size_t) {
      if (failed && failed != http::error::end_of_stream) return;
      if (self->watches_)
        self->watch();
      else if (goes_on)
        self->read();
      else
        self->part();
    });
  }

  /// Server-sent events, for as long as the page listens.
  void watch() {
    text_ = site_.host.news(heard_, 0ms);
    if (text_.empty() && Clock::now() - said_ < longest_silence) {
      timer_.expires_after(pause);
      timer_.async_wait([self = shared_from_this()](Error error) {
        if (!error) self->watch();
      });
      return;
    }
    text_ = text_.empty() ? ": nothing new\n\n" : "data: " + text_ + "\n\n";
    said_ = Clock::now();
    stream_.expires_after(longest_answer);
    asio::async_write(stream_, asio::buffer(text_), [self = shared_from_this()](Error error, std::size_t) {
      if (!error) self->watch();
    });
  }

  /// What is still being sent is let pass: the answer would be lost with it.
  void part() {
    Error ignored;
    stream_.socket().shutdown(tcp::socket::shutdown_send, ignored);
    stream_.expires_after(longest_farewell);
    let_pass();
  }
  void let_pass() {
    buffer_.clear();
    stream_.async_read_some(buffer_.prepare(most_body),
                            [self = shared_from_this()](Error error, std::size_t) {
                              if (!error) self->let_pass();
                            });
  }

  Site& site_;
  beast::tcp_stream stream_;
  asio::steady_timer timer_;
  beast::flat_buffer buffer_{most_head + most_body};
  std::optional<http::request_parser<http::string_body>> parser_{};
  Answer answer_{};
  bool watches_ = false;
  Heard heard_{};
  std::string text_{};
  Clock::time_point said_{};
};

}  // namespace

struct Server::Inside {
  Inside(Host& host, Page page, int port) : site{host, std::move(page), new_token()} {
    const tcp::endpoint here(asio::ip::make_address(this_machine), static_cast<unsigned short>(port));
    Error error;
    acceptor.open(here.protocol(), error);
    if (!error) acceptor.set_option(tcp::acceptor::reuse_address(true), error);
    if (!error) acceptor.bind(here, error);
    if (!error) acceptor.listen(static_cast<int>(most_connections), error);
    if (error) cannot_listen(error.value(), port);
    site.port = acceptor.local_endpoint().port();
    accept();
    thread = std::thread([this] { io.run(); });
  }
  Inside(const Inside&) = delete;
  Inside& operator=(const Inside&) = delete;
  ~Inside() {
    io.stop();
    thread.join();
  }

  /// Who is one too many takes the place of the oldest that does not watch.
  void accept() {
    acceptor.async_accept([this](Error error, tcp::socket socket) {
      if (error == asio::error::operation_aborted) return;
      if (error) {
        std::this_thread::sleep_for(pause);  // no descriptors are left
      } else {
        socket.set_option(tcp::no_delay(true), error);
        if (site.open.size() + site.watchers >= most_connections) {
          site.open.front()->close();
          site.open.pop_front();
        }
        std::make_shared<Connection>(std::move(socket), site)->read();
      }
      accept();
    });
  }

  Site site;
  asio::io_context io{1};
  tcp::acceptor acceptor{io};
  std::thread thread{};
};

Server::Server(Host& host, Page page, int port)
    : inside_(std::make_unique<Inside>(host, std::move(page), port)) {}

Server::~Server() = default;

std::string Server::address() const {
  return fmt::format("http://{}:{}/{}/", this_machine, inside_->site.port, inside_->site.token);
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
