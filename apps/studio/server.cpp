// SPDX-License-Identifier: GPL-3.0-or-later
// Accepts connections.
#include "server.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <boost/asio/post.hpp>
#include <boost/beast/core/error.hpp>
#include <chrono>

#include "hyperex/core/error.hpp"
#include "server_impl.hpp"

namespace hyperex::studio {
namespace {

constexpr const char* kPolicy =
    "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data: "
    "blob:; connect-src 'self' ws://127.0.0.1:{0} ws://localhost:{0}; base-uri 'none'; "
    "form-action 'none'; frame-ancestors 'none'";

}  // namespace

bool Server::Impl::make_room() {
  peers.remove_if([](const std::weak_ptr<Peer>& peer) { return peer.expired(); });
  if (connections < options.most_connections) return true;
  for (auto one = peers.begin(); one != peers.end(); ++one) {
    const std::shared_ptr<Peer> peer = one->lock();
    if (peer->proven()) continue;
    peers.erase(one);
    peer->close();
    return true;
  }
  return false;
}

void Server::Impl::accept() {
  acceptor.async_accept([this](beast::error_code error, tcp::socket socket) {
    if (error == asio::error::operation_aborted) return;
    if (error) {  // no file descriptor is left: try again later
      retry.expires_after(std::chrono::milliseconds(200));
      retry.async_wait([this](beast::error_code stopped) {
        if (!stopped) accept();
      });
      return;
    }
    // Child processes, such as the browser, must not inherit it.
    fcntl(socket.native_handle(), F_SETFD, FD_CLOEXEC);
    // Without Nagle's algorithm, which delays small answers by 40 ms.
    if (!error) socket.set_option(tcp::no_delay(true), error);
    if (!error && make_room()) serve_http(std::move(socket));
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
    throw InputError("--port", fmt::format("{}: cannot listen on this port ({}); expected a free "
                                           "one, or none to choose one",
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
      // One connection failed and is closed; the others go on.
      spdlog::warn("the studio's network: {}", error.what());
    }
}

void Server::stop() {
  asio::post(impl_->io, [this] {
    impl_->acceptor.close();
    impl_->retry.cancel();
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
