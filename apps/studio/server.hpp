// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The studio's network: one page, one socket, uploads; on the loopback address alone.
//
// What it holds out against: pages of other origins and names that were made to point here (Host
// and Origin of every request), guesses of the token, torn, oversized and too many messages, slow
// readers, uploads without end, names of files that lead elsewhere. A client is dropped for it; the
// server and what the user has open stay.
#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

namespace hyperex::studio {

struct ServerOptions {
  std::string_view page;                                 ///< HTML, served at "/"
  std::string token;                                     ///< that the first message must hold
  unsigned short port = 0;                               ///< 0: one that is free
  std::filesystem::path uploads;                         ///< a folder that is there
  std::size_t longest_message = std::size_t(16) << 20U;  ///< of a client, bytes
  std::size_t longest_upload = std::size_t(1) << 30U;    ///< bytes; all uploads together twice that
  std::size_t most_waiting = std::size_t(512)
                             << 20U;  ///< bytes that a slow reader may leave unread
  int most_connections = 16;
  double messages_per_s = 400;
};

/// All are called on the thread of run().
struct ServerEvents {
  std::function<void(std::string text)> request;  ///< of the client that is let in
  /// A file of that name lies in `uploads`: the client's, with a number where there was one.
  std::function<void(std::string name)> uploaded;
};

class Server {
 public:
  /// Takes the port. Throws InputError where that cannot be.
  Server(ServerOptions options, ServerEvents events);
  ~Server();
  unsigned short port() const;
  /// "http://127.0.0.1:PORT/#TOKEN"
  std::string address() const;

  /// Serves until stop().
  void run();

  // From any thread:
  void stop();
  /// To the client that is let in; lost where there is none. Of messages with the same `replaces`
  /// (not empty) that wait to be sent the last one goes.
  void send(std::string message, bool binary, const std::string& replaces = "");

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Whether an upload may be called so: letters, digits, spaces and any of -_.() , not beginning
/// with a dot, at most 100 bytes; the rest of UTF-8 besides, without control characters.
bool is_upload_name(std::string_view name);

}  // namespace hyperex::studio
