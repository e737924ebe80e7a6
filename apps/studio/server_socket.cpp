// SPDX-License-Identifier: GPL-3.0-or-later
// The page's WebSocket: its first message must hold the token; rates and sizes are limited.
#include <algorithm>
#include <boost/beast/core.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <deque>
#include <nlohmann/json.hpp>

#include "server_impl.hpp"
#include "token.hpp"

namespace hyperex::studio {
namespace {

namespace websocket = beast::websocket;
using std::chrono::steady_clock;

constexpr std::size_t kLongestHello = 4096;
constexpr auto kHelloWithin = std::chrono::seconds(10);

/// A WebSocket, from its upgrade on.
class Socket : public std::enable_shared_from_this<Socket>, public PageSocket {
 public:
  Socket(Server::Impl& server, tcp::socket&& socket)
      : server_(server), stream_(std::move(socket)), hello_timer_(server.io) {
    ++server_.connections;
  }
  ~Socket() override { --server_.connections; }
  bool proven() const override { return proven_ && !ended_; }
  void close() override {
    ended_ = true;
    hello_timer_.cancel();
    beast::get_lowest_layer(stream_).close();
  }

  void start(const Server::Impl::Request& request) {
    server_.peers.push_back(weak_from_this());
    websocket::stream_base::timeout timeouts =
        websocket::stream_base::timeout::suggested(beast::role_type::server);
    timeouts.keep_alive_pings = true;
    stream_.set_option(timeouts);
    stream_.read_message_max(kLongestHello);
    stream_.async_accept(request, [self = shared_from_this()](beast::error_code error) {
      if (error) return;
      self->hello_timer_.expires_after(kHelloWithin);
      self->hello_timer_.async_wait([weak = std::weak_ptr(self)](beast::error_code late) {
        if (const auto one = weak.lock(); one && !late && !one->proven_)
          one->end(websocket::close_code::policy_error, "no hello came");
      });
      self->read();
    });
  }

  void send(std::shared_ptr<const std::string> message, bool binary,
            const std::string& replaces) override {
    if (ended_) return;
    // The new message goes to the end of the queue, not to the place of the one it replaces.
    if (!replaces.empty())
      for (std::size_t i = writing_ ? 1 : 0; i < queue_.size(); ++i)
        if (queue_[i].replaces == replaces) {
          waiting_ -= queue_[i].message->size();
          queue_.erase(queue_.begin() + std::ptrdiff_t(i));
          break;
        }
    waiting_ += message->size();
    if (waiting_ > server_.options.most_waiting)
      return end(websocket::close_code::policy_error, "reads too slowly");
    queue_.push_back({std::move(message), binary, replaces});
    if (!writing_) write();
  }

  void yield() override { end(websocket::close_code::going_away, "another page took over"); }

  void end(websocket::close_code code, const char* why) {
    if (ended_) return;
    ended_ = true;
    hello_timer_.cancel();
    if (server_.client.get() == this) server_.client.reset();
    if (writing_) {  // a peer that reads nothing would never read the closing frame
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
      self->receive(beast::buffers_to_string(self->buffer_.data()));
      self->buffer_.consume(self->buffer_.size());
      if (!self->ended_) self->read();
    });
  }

  void receive(std::string text) {
    if (!proven_) return check_hello(std::move(text));
    const auto now = steady_clock::now();
    const double rate = server_.options.messages_per_s;
    allowance_ =
        std::min(rate, allowance_ + rate * std::chrono::duration<double>(now - last_).count());
    last_ = now;
    if (allowance_ < 1) return end(websocket::close_code::policy_error, "too many messages");
    allowance_ -= 1;
    server_.events.request(std::move(text));
  }

  void check_hello(std::string text) {
    const auto message = nlohmann::json::parse(text, nullptr, false);
    const bool right = stream_.got_text() && message.is_object() &&
                       message.value("do", nlohmann::json()) == "hello" &&
                       message.contains("token") && message["token"].is_string() &&
                       same_token(message["token"].get<std::string>(), server_.options.token);
    if (!right) return end(websocket::close_code::policy_error, "not the printed address");
    proven_ = true;
    hello_timer_.cancel();
    allowance_ = server_.options.messages_per_s;
    last_ = steady_clock::now();
    stream_.read_message_max(server_.options.longest_message);
    if (const auto before = server_.client) before->yield();
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

  Server::Impl& server_;
  websocket::stream<beast::tcp_stream> stream_;
  asio::steady_timer hello_timer_;
  beast::flat_buffer buffer_;
  std::deque<Outgoing> queue_;
  std::size_t waiting_ = 0;
  bool proven_ = false, writing_ = false, ended_ = false;
  double allowance_ = 0;
  steady_clock::time_point last_;
};

}  // namespace

void Server::Impl::serve_socket(tcp::socket&& socket, const Request& request) {
  std::make_shared<Socket>(*this, std::move(socket))->start(request);
}

}  // namespace hyperex::studio
