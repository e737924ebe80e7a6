// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The parts of the server: connections are accepted here (server.cpp), answered as HTTP
// (server_http.cpp), and one of them may become the page's WebSocket (server_socket.cpp).
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/message.hpp>
#include <list>
#include <memory>
#include <string>

#include "server.hpp"

namespace hyperex::studio {

namespace asio = boost::asio;
namespace beast = boost::beast;
using tcp = asio::ip::tcp;

/// A connected peer. A peer that is not proven to be the user's page is closed first when there are
/// too many.
class Peer {
 public:
  virtual ~Peer() = default;
  virtual bool proven() const = 0;
  virtual void close() = 0;  ///< at once
};

/// The page's WebSocket, after the correct token was received.
class PageSocket : public Peer {
 public:
  virtual void send(std::shared_ptr<const std::string> message, bool binary,
                    const std::string& replaces) = 0;
  /// Closes the socket, since another page has taken over.
  virtual void yield() = 0;
};

struct Server::Impl {
  using Request = beast::http::request<beast::http::empty_body>;

  ServerOptions options;
  ServerEvents events;
  asio::io_context io{1};
  tcp::acceptor acceptor{io};
  unsigned short port = 0;
  std::string policy;                  ///< Content-Security-Policy of each answer
  std::shared_ptr<PageSocket> client;  ///< null: no page has shown the token
  int connections = 0;
  std::list<std::weak_ptr<Peer>> peers;  ///< oldest first
  std::size_t uploading = 0;             ///< bytes reserved for uploads in progress
  int parts = 0;                         ///< uploads begun
  asio::steady_timer retry{io};

  void accept();
  /// Whether another connection may be accepted. Closes the oldest unproven one if need be.
  bool make_room();
  /// Answers requests of a new connection (server_http.cpp).
  void serve_http(tcp::socket&& socket);
  /// Upgrades a connection to a WebSocket (server_socket.cpp).
  void serve_socket(tcp::socket&& socket, const Request& request);
};

}  // namespace hyperex::studio
