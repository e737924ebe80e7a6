// SPDX-License-Identifier: GPL-3.0-or-later
#include "server.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <deque>
#include <limits>
#include <list>
#include <nlohmann/json.hpp>
#include <optional>

#include "access.hpp"
#include "hyperex/core/error.hpp"
#include "token.hpp"

namespace hyperex::studio {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using tcp = asio::ip::tcp;
using std::chrono::seconds;
using std::chrono::steady_clock;

constexpr std::size_t kLongestHead = 16384, kLongestHello = 4096;
constexpr auto kHttpWithin = seconds(30), kHelloWithin = seconds(10), kFarewell = seconds(5);
constexpr const char* kSocketPath = "/socket";
constexpr std::string_view kUploadPath = "/upload/";
constexpr const char* kPolicy =
    "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data: "
    "blob:; connect-src 'self' ws://127.0.0.1:{0} ws://localhost:{0}; base-uri 'none'; "
    "form-action 'none'; frame-ancestors 'none'";

std::string_view view(beast::string_view text) {
  return {text.data(), text.size()};
}

/// "%20" as a space; nothing where that is no such text.
std::optional<std::string> unescaped(std::string_view text) {
  const auto digit = [](char c) {
    return c >= '0' && c <= '9'   ? c - '0'
           : c >= 'a' && c <= 'f' ? c - 'a' + 10
           : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                  : -1;
  };
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '%') {
      out += text[i];
      continue;
    }
    if (i + 2 >= text.size() || digit(text[i + 1]) < 0 || digit(text[i + 2]) < 0)
      return std::nullopt;
    out += static_cast<char>(16 * digit(text[i + 1]) + digit(text[i + 2]));
    i += 2;
  }
  return out;
}

/// "me.ply", or where that is there already "me-2.ply": scenes may name the one that is there.
std::string free_name(const std::filesystem::path& folder, const std::string& name) {
  const std::filesystem::path path = name;
  std::string free = name;
  for (int i = 2; std::filesystem::exists(folder / free); ++i)
    free = fmt::format("{}-{}{}", path.stem().string(), i, path.extension().string());
  return free;
}

}  // namespace

bool is_upload_name(std::string_view name) {
  if (name.empty() || name.size() > 100 || name.front() == '.' || name.front() == ' ') return false;
  try {
    static_cast<void>(nlohmann::json(std::string(name)).dump());
  } catch (const nlohmann::json::exception&) {
    return false;  // no UTF-8
  }
  for (std::size_t i = 1; i < name.size(); ++i)  // C1 controls
    if (name[i - 1] == '\xc2' && static_cast<unsigned char>(name[i]) < 0xa0) return false;
  return std::all_of(name.begin(), name.end(), [](char c) {
    const auto u = static_cast<unsigned char>(c);
    return u >= 0x80 || std::isalnum(u) || std::string_view(" -_.()").find(c) != std::string::npos;
  });
}

namespace {

/// Whoever has connected. Who has not shown that he is the user's page gives way to others.
class Guest {
 public:
  virtual ~Guest() = default;
  virtual bool proven() const = 0;
  virtual void evict() = 0;  ///< at once
};

}  // namespace

struct Server::Impl {
  class Socket;
  class Connection;

  ServerOptions options;
  ServerEvents events;
  asio::io_context io{1};
  tcp::acceptor acceptor{io};
  unsigned short port = 0;
  std::string policy;
  std::shared_ptr<Socket> client;  // that was let in
  int connections = 0;
  std::list<std::weak_ptr<Guest>> guests;  // those that came first, first
  std::size_t uploaded = 0;                // bytes in all
  int parts = 0;
  asio::steady_timer again{io};

  void accept();
  void admit(const std::shared_ptr<Guest>& guest) { guests.push_back(guest); }
  bool make_room();
};

/// Where all places are taken, the one goes that came first of those that are not proven.
bool Server::Impl::make_room() {
  guests.remove_if([](const std::weak_ptr<Guest>& guest) { return guest.expired(); });
  if (connections < options.most_connections) return true;
  for (auto one = guests.begin(); one != guests.end(); ++one) {
    const std::shared_ptr<Guest> guest = one->lock();
    if (guest->proven()) continue;
    guests.erase(one);
    guest->evict();
    return true;
  }
  return false;
}

/// A page's socket, from its upgrade on.
class Server::Impl::Socket : public std::enable_shared_from_this<Socket>, public Guest {
 public:
  Socket(Impl& server, tcp::socket&& socket)
      : server_(server), stream_(std::move(socket)), hello_timer_(server.io) {
    ++server_.connections;
  }
  ~Socket() override { --server_.connections; }
  bool proven() const override { return let_in_ && !ended_; }
  void evict() override {
    ended_ = true;
    hello_timer_.cancel();
    beast::get_lowest_layer(stream_).close();
  }

  void start(const http::request<http::empty_body>& request) {
    server_.admit(shared_from_this());
    websocket::stream_base::timeout timeouts =
        websocket::stream_base::timeout::suggested(beast::role_type::server);
    timeouts.keep_alive_pings = true;
    stream_.set_option(timeouts);
    stream_.read_message_max(kLongestHello);
    stream_.async_accept(request, [self = shared_from_this()](beast::error_code error) {
      if (error) return;
      self->hello_timer_.expires_after(kHelloWithin);
      self->hello_timer_.async_wait([weak = std::weak_ptr(self)](beast::error_code late) {
        if (const auto one = weak.lock(); one && !late && !one->let_in_)
          one->end(websocket::close_code::policy_error, "no hello came");
      });
      self->read();
    });
  }

  void send(std::shared_ptr<const std::string> message, bool binary, const std::string& replaces) {
    if (ended_) return;
    // The new one takes its own place: what was sent in between comes before it.
    if (!replaces.empty())
      for (std::size_t i = writing_ ? 1 : 0; i < queue_.size(); ++i)
        if (queue_[i].replaces == replaces) {
          waiting_ -= queue_[i].message->size();
          queue_.erase(queue_.begin() + std::ptrdiff_t(i));
          break;
        }
    waiting_ += message->size();
    if (waiting_ > server_.options.most_waiting)
      return end(websocket::close_code::policy_error, "too slow a reader");
    queue_.push_back({std::move(message), binary, replaces});
    if (!writing_) write();
  }

  void end(websocket::close_code code, const char* why) {
    if (ended_) return;
    ended_ = true;
    hello_timer_.cancel();
    if (server_.client.get() == this) server_.client.reset();
    if (writing_) {  // a reader that takes nothing would never take the farewell
      beast::get_lowest_layer(stream_).close();
      return;
    }
    stream_.async_close({code, why}, [self = shared_from_this()](beast::error_code) {});
  }

 private:
  struct Outgoing {
    std::shared_ptr<const std::string> message;
    bool binary;
    std::string replaces;
  };

  void read() {
    stream_.async_read(buffer_, [self = shared_from_this()](beast::error_code error, std::size_t) {
      if (error || self->ended_) return self->lost();
      self->take(beast::buffers_to_string(self->buffer_.data()));
      self->buffer_.consume(self->buffer_.size());
      if (!self->ended_) self->read();
    });
  }

  void take(std::string text) {
    if (!let_in_) return knock(std::move(text));
    const auto now = steady_clock::now();
    const double rate = server_.options.messages_per_s;
    allowance_ =
        std::min(rate, allowance_ + rate * std::chrono::duration<double>(now - last_).count());
    last_ = now;
    if (allowance_ < 1) return end(websocket::close_code::policy_error, "too many messages");
    allowance_ -= 1;
    server_.events.request(std::move(text));
  }

  void knock(std::string text) {
    const auto message = nlohmann::json::parse(text, nullptr, false);
    const bool right = stream_.got_text() && message.is_object() &&
                       message.value("do", nlohmann::json()) == "hello" &&
                       message.contains("token") && message["token"].is_string() &&
                       same_token(message["token"].get<std::string>(), server_.options.token);
    if (!right) return end(websocket::close_code::policy_error, "not the address that was printed");
    let_in_ = true;
    hello_timer_.cancel();
    allowance_ = server_.options.messages_per_s;
    last_ = steady_clock::now();
    stream_.read_message_max(server_.options.longest_message);
    if (const auto before = server_.client)
      before->end(websocket::close_code::going_away, "another page took over");
    server_.client = shared_from_this();
    server_.events.request(std::move(text));
  }

  void write() {
    writing_ = true;
    stream_.binary(queue_.front().binary);
    stream_.async_write(asio::buffer(*queue_.front().message),
                        [self = shared_from_this()](beast::error_code error, std::size_t) {
                          self->writing_ = false;
                          if (error || self->ended_) return self->lost();
                          self->waiting_ -= self->queue_.front().message->size();
                          self->queue_.pop_front();
                          if (!self->queue_.empty()) self->write();
                        });
  }

  void lost() {
    ended_ = true;
    hello_timer_.cancel();
    if (server_.client.get() == this) server_.client.reset();
  }

  Impl& server_;
  websocket::stream<beast::tcp_stream> stream_;
  asio::steady_timer hello_timer_;
  beast::flat_buffer buffer_;
  std::deque<Outgoing> queue_;
  std::size_t waiting_ = 0;
  bool let_in_ = false, writing_ = false, ended_ = false;
  double allowance_ = 0;
  steady_clock::time_point last_;
};

/// HTTP, until it asks for the socket.
class Server::Impl::Connection : public std::enable_shared_from_this<Connection>, public Guest {
 public:
  Connection(Impl& server, tcp::socket&& socket) : server_(server), stream_(std::move(socket)) {
    ++server_.connections;
  }
  ~Connection() override { --server_.connections; }
  bool proven() const override { return upload_.has_value(); }  // which takes the token
  void evict() override { stream_.close(); }

  void start() {
    server_.admit(shared_from_this());
    read();
  }

 private:
  void read() {
    head_.emplace();
    head_->header_limit(kLongestHead);
    // take_upload() looks at the length itself, and says so.
    head_->body_limit(std::numeric_limits<std::uint64_t>::max());
    stream_.expires_after(kHttpWithin);
    http::async_read_header(stream_, buffer_, *head_,
                            [self = shared_from_this()](beast::error_code error, std::size_t) {
                              if (!error) self->take();
                            });
  }

  void take() {
    const http::request<http::empty_body>& request = head_->get();
    const std::string_view target = view(request.target());
    if (!own_host(view(request[http::field::host]), server_.port))
      return answer(http::status::forbidden, "this is not the studio's address\n");
    if (websocket::is_upgrade(request)) {
      if (target != kSocketPath || !own_origin(view(request[http::field::origin]), server_.port))
        return answer(http::status::forbidden, "the socket is for the studio's own page\n");
      stream_.expires_never();
      const auto socket = std::make_shared<Socket>(server_, stream_.release_socket());
      return socket->start(request);
    }
    if (target.substr(0, kUploadPath.size()) == kUploadPath) return take_upload();
    if (request.method() != http::verb::get && request.method() != http::verb::head)
      return answer(http::status::method_not_allowed, "\n");
    if (target != "/") return answer(http::status::not_found, "there is one page: /\n");
    answer(http::status::ok, std::string(server_.options.page), "text/html; charset=utf-8");
  }

  void take_upload() {
    const http::request<http::empty_body>& request = head_->get();
    if (request.method() != http::verb::post) return answer(http::status::method_not_allowed, "\n");
    const auto name = unescaped(view(request.target()).substr(kUploadPath.size()));
    if (!own_origin(view(request[http::field::origin]), server_.port) ||
        !same_token(view(request[http::field::authorization]), "Bearer " + server_.options.token))
      return answer(http::status::forbidden, "uploads are for the studio's own page\n");
    if (!name || !is_upload_name(*name))
      return answer(http::status::bad_request, "expected a plain file name\n");
    const auto length = head_->content_length();
    if (!length || *length > server_.options.longest_upload ||
        server_.uploaded + *length > 2 * server_.options.longest_upload)
      return answer(http::status::payload_too_large,
                    fmt::format("expected at most {} MB a file, {} MB in all\n",
                                server_.options.longest_upload >> 20U,
                                server_.options.longest_upload >> 19U));
    server_.uploaded += *length;
    charged_ = *length;
    name_ = free_name(server_.options.uploads, *name);
    upload_.emplace(std::move(*head_));
    upload_->body_limit(server_.options.longest_upload);
    beast::error_code error;
    // Under its own name only when it is whole.
    const std::string part =
        (server_.options.uploads / fmt::format(".part-{}-{}", ++server_.parts, name_)).string();
    upload_->get().body().open(part.c_str(), beast::file_mode::write, error);
    if (error) server_.uploaded -= charged_;
    if (error) return answer(http::status::insufficient_storage, "the file cannot be written\n");
    stream_.expires_after(seconds(600));
    http::async_read(
        stream_, buffer_, *upload_,
        [self = shared_from_this(), part](beast::error_code failed, std::size_t) {
          self->upload_->get().body().close();
          std::error_code ignored;
          if (failed) {
            std::filesystem::remove(part, ignored);
            self->server_.uploaded -= self->charged_;
            return;
          }
          self->name_ = free_name(self->server_.options.uploads, self->name_);
          std::filesystem::rename(part, self->server_.options.uploads / self->name_, ignored);
          if (ignored)
            return self->answer(http::status::insufficient_storage, "the file cannot be written\n");
          self->server_.events.uploaded(self->name_);
          self->answer(http::status::ok, nlohmann::json{{"name", self->name_}}.dump(),
                       "application/json");
        });
  }

  void answer(http::status status, std::string body, const char* type = "text/plain") {
    answer_.version(11);
    answer_.result(status);
    answer_.set(http::field::content_type, type);
    answer_.set("Content-Security-Policy", server_.policy);
    answer_.set("X-Content-Type-Options", "nosniff");
    answer_.set("X-Frame-Options", "DENY");
    answer_.set("Cross-Origin-Opener-Policy", "same-origin");
    answer_.set("Cross-Origin-Resource-Policy", "same-origin");
    answer_.set("Referrer-Policy", "no-referrer");
    answer_.set(http::field::cache_control, "no-store");
    answer_.keep_alive(false);
    answer_.body() = std::move(body);
    answer_.prepare_payload();
    stream_.expires_after(kHttpWithin);
    http::async_write(stream_, answer_,
                      [self = shared_from_this()](beast::error_code, std::size_t) {
                        beast::error_code ignored;
                        self->stream_.socket().shutdown(tcp::socket::shutdown_send, ignored);
                        self->stream_.expires_after(kFarewell);
                        self->let_talk();
                      });
  }

  /// Reads on for a moment: a connection that is closed while it has unread bytes loses the answer.
  void let_talk() {
    buffer_.clear();
    stream_.async_read_some(buffer_.prepare(65536),
                            [self = shared_from_this()](beast::error_code error, std::size_t) {
                              if (!error) self->let_talk();
                            });
  }

  Impl& server_;
  beast::tcp_stream stream_;
  beast::flat_buffer buffer_{65536};
  std::optional<http::request_parser<http::empty_body>> head_;
  std::optional<http::request_parser<http::file_body>> upload_;
  http::response<http::string_body> answer_;
  std::string name_;
  std::size_t charged_ = 0;
};

void Server::Impl::accept() {
  acceptor.async_accept([this](beast::error_code error, tcp::socket socket) {
    if (error == asio::error::operation_aborted) return;
    if (error) {  // no file descriptor is left: wait until some are
      again.expires_after(std::chrono::milliseconds(200));
      again.async_wait([this](beast::error_code stopped) {
        if (!stopped) accept();
      });
      return;
    }
    // Programs that are started, as the browser, must not hold it.
    fcntl(socket.native_handle(), F_SETFD, FD_CLOEXEC);
    // Small answers go at once: held back for others they would come 40 ms late.
    if (!error) socket.set_option(tcp::no_delay(true), error);
    if (!error && make_room()) std::make_shared<Connection>(*this, std::move(socket))->start();
    accept();
  });
}

Server::Server(ServerOptions options, ServerEvents events) : impl_(std::make_unique<Impl>()) {
  Impl& m = *impl_;
  m.options = std::move(options);
  m.events = std::move(events);
  beast::error_code error;
  const tcp::endpoint at(asio::ip::address_v4::loopback(), m.options.port);
  m.acceptor.open(at.protocol(), error);
  if (!error) m.acceptor.set_option(asio::socket_base::reuse_address(true), error);
  if (!error) m.acceptor.bind(at, error);
  if (!error) m.acceptor.listen(asio::socket_base::max_listen_connections, error);
  if (error)
    throw InputError("--port", fmt::format("{}: this port cannot be taken ({}); expected a free "
                                           "one, or none to have one chosen",
                                           m.options.port, error.message()));
  fcntl(m.acceptor.native_handle(), F_SETFD, FD_CLOEXEC);
  m.port = m.acceptor.local_endpoint().port();
  m.policy = fmt::format(fmt::runtime(kPolicy), m.port);
}
Server::~Server() = default;

unsigned short Server::port() const {
  return impl_->port;
}
std::string Server::address() const {
  return fmt::format("http://127.0.0.1:{}/#{}", impl_->port, impl_->options.token);
}

void Server::run() {
  impl_->accept();
  while (!impl_->io.stopped()) try {
      impl_->io.run();
    } catch (const std::exception& error) {
      // Of one connection, which is gone with it; the others go on.
      spdlog::warn("the studio's network: {}", error.what());
    }
}

void Server::stop() {
  asio::post(impl_->io, [this] {
    impl_->acceptor.close();
    impl_->again.cancel();
    impl_->client.reset();
    impl_->io.stop();
  });
}

void Server::send(std::string message, bool binary, const std::string& replaces) {
  auto shared = std::make_shared<const std::string>(std::move(message));
  asio::post(impl_->io, [this, shared = std::move(shared), binary, replaces] {
    if (const auto client = impl_->client) client->send(shared, binary, replaces);
  });
}

}  // namespace hyperex::studio
