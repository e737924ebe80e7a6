// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The studio's network: one page, one WebSocket, uploads; on the loopback address only.
//
// The server is protected against pages of other origins and DNS rebinding (it checks Host and
// Origin of every request), guesses of the token, malformed, oversized and too many messages, slow
// readers, endless uploads, and file names that lead out of the folder. Such a client is
// disconnected; the server and the user's work go on.
#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

namespace hyperex::studio {

struct ServerOptions {
  std::string_view page;                                 ///< HTML, served at "/"
  std::string token;                                     ///< must be in the first message
  unsigned short port = 0;                               ///< 0: any free one
  std::filesystem::path uploads;                         ///< an existing folder
  std::size_t longest_message = std::size_t(16) << 20U;  ///< of a client, bytes
  std::size_t longest_upload = std::size_t(1) << 30U;    ///< bytes; all uploads together twice that
  std::size_t most_waiting = std::size_t(512) << 20U;    ///< bytes that may wait for a slow reader
  int most_connections = 16;
  double messages_per_s = 400;
};

/// Called on the thread of run().
struct ServerEvents {
  std::function<void(std::string text)> request;  ///< a message of the page
  /// A file was uploaded. `name`: the client's, with a number added if the name was taken.
  std::function<void(std::string name)> uploaded;
};

class Server {
 public:
  /// Listens on the port. Throws InputError where that fails.
  Server(ServerOptions options, ServerEvents events);
  ~Server();
  unsigned short port() const;
  /// "http://127.0.0.1:PORT/#TOKEN"
  std::string address() const;

  /// Serves until stop().
  void run();

  // From any thread:
  void stop();
  /// Sends to the page; does nothing where there is none. A message replaces a waiting one with the
  /// same `replaces`, unless that is empty.
  void send(std::string message, bool binary, const std::string& replaces = "");

  struct Impl;

 private:
  std::unique_ptr<Impl> impl_;
};

}  // namespace hyperex::studio
