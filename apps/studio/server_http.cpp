// SPDX-License-Identifier: GPL-3.0-or-later
// The page and uploads over HTTP.
#include <fmt/format.h>

#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket/rfc6455.hpp>
#include <cerrno>
#include <chrono>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>

#include "access.hpp"
#include "server_impl.hpp"
#include "token.hpp"
#include "upload_name.hpp"

namespace hyperex::studio {
namespace {

namespace http = beast::http;
namespace websocket = beast::websocket;
using std::chrono::seconds;

constexpr std::size_t kLongestHead = 16384;
constexpr auto kHttpWithin = seconds(30), kUploadWithin = seconds(600), kDrainFor = seconds(5);
constexpr const char* kSocketPath = "/socket";
constexpr std::string_view kUploadPath = "/upload/";

std::string_view view(beast::string_view text) {
  return {text.data(), text.size()};
}

/// Bytes of the files that were uploaded and are still there.
std::uintmax_t bytes_of_uploads(const std::filesystem::path& folder) {
  std::uintmax_t all = 0;
  std::error_code error;
  for (std::filesystem::directory_iterator at(folder, error), end; !error && at != end;
       at.increment(error)) {
    std::error_code gone;
    const bool whole = at->path().filename().string().front() != '.';
    if (whole && at->is_regular_file(gone))
      if (const auto bytes = at->file_size(gone); !gone) all += bytes;
  }
  return all;
}

/// Whether the disk could not take more of a file; otherwise the connection has failed.
bool is_of_disk(const beast::error_code& error) {
  const bool of_system = error.category() == boost::system::generic_category() ||
                         error.category() == boost::system::system_category();
  return of_system && (error.value() == ENOSPC || error.value() == EDQUOT ||
                       error.value() == EFBIG || error.value() == EIO);
}

/// One HTTP request and its answer. An upgrade hands the connection over to the WebSocket.
class Connection : public std::enable_shared_from_this<Connection>, public Peer {
 public:
  Connection(Server::Impl& server, tcp::socket&& socket)
      : server_(server), stream_(std::move(socket)) {
    ++server_.connections;
  }
  ~Connection() override { --server_.connections; }
  bool proven() const override { return upload_.has_value(); }  // an upload needs the token
  void close() override { stream_.close(); }

  void start() {
    server_.peers.push_back(weak_from_this());
    read();
  }

 private:
  void read() {
    head_.emplace();
    head_->header_limit(kLongestHead);
    // take_upload() checks the length itself and explains the limit.
    head_->body_limit(std::numeric_limits<std::uint64_t>::max());
    stream_.expires_after(kHttpWithin);
    http::async_read_header(stream_, buffer_, *head_,
                            [self = shared_from_this()](beast::error_code error, std::size_t) {
                              if (!error) self->handle();
                            });
  }

  void handle() {
    const http::request<http::empty_body>& request = head_->get();
    const std::string_view target = view(request.target());
    if (!own_host(view(request[http::field::host]), server_.port))
      return answer(http::status::forbidden, "this is not the studio's address\n");
    if (websocket::is_upgrade(request)) {
      if (target != kSocketPath || !own_origin(view(request[http::field::origin]), server_.port))
        return answer(http::status::forbidden, "the socket is for the studio's own page\n");
      stream_.expires_never();
      return server_.serve_socket(stream_.release_socket(), request);
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
    const auto name = percent_decoded(view(request.target()).substr(kUploadPath.size()));
    if (!own_origin(view(request[http::field::origin]), server_.port) ||
        !same_token(view(request[http::field::authorization]), "Bearer " + server_.options.token))
      return answer(http::status::forbidden, "uploads are for the studio's own page\n");
    if (!name || !is_upload_name(*name))
      return answer(http::status::bad_request, "expected a plain file name\n");
    const auto length = head_->content_length();
    if (!length || *length > server_.options.longest_upload ||
        bytes_of_uploads(server_.options.uploads) + server_.uploading + *length >
            2 * server_.options.longest_upload)
      return answer(http::status::payload_too_large,
                    fmt::format("expected at most {} MB a file, {} MB in all\n",
                                server_.options.longest_upload >> 20U,
                                server_.options.longest_upload >> 19U));
    server_.uploading += *length;
    charged_ = *length;
    name_ = unused_name(server_.options.uploads, *name);
    upload_.emplace(std::move(*head_));
    upload_->body_limit(server_.options.longest_upload);
    beast::error_code error;
    // It gets its own name when it is complete.
    const std::string part =
        (server_.options.uploads / fmt::format(".part-{}-{}", ++server_.parts, name_)).string();
    upload_->get().body().open(part.c_str(), beast::file_mode::write, error);
    if (error) server_.uploading -= charged_;
    if (error) return answer(http::status::insufficient_storage, "the file cannot be written\n");
    stream_.expires_after(kUploadWithin);
    http::async_read(
        stream_, buffer_, *upload_,
        [self = shared_from_this(), part](beast::error_code failed, std::size_t) {
          self->upload_->get().body().close();
          self->server_.uploading -= self->charged_;
          std::error_code ignored;
          if (failed) {
            std::filesystem::remove(part, ignored);
            if (is_of_disk(failed))
              self->answer(
                  http::status::insufficient_storage,
                  fmt::format("{}: cannot be written ({})\n", self->name_, failed.message()));
            return;
          }
          self->name_ = unused_name(self->server_.options.uploads, self->name_);
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
                        self->stream_.expires_after(kDrainFor);
                        self->drain();
                      });
  }

  /// Reads on for a moment: closing a connection with unread bytes would lose the answer.
  void drain() {
    buffer_.clear();
    stream_.async_read_some(buffer_.prepare(65536),
                            [self = shared_from_this()](beast::error_code error, std::size_t) {
                              if (!error) self->drain();
                            });
  }

  Server::Impl& server_;
  beast::tcp_stream stream_;
  beast::flat_buffer buffer_{65536};
  std::optional<http::request_parser<http::empty_body>> head_;
  std::optional<http::request_parser<http::file_body>> upload_;
  http::response<http::string_body> answer_;
  std::string name_;
  std::size_t charged_ = 0;
};

}  // namespace

void Server::Impl::serve_http(tcp::socket&& socket) {
  std::make_shared<Connection>(*this, std::move(socket))->start();
}

}  // namespace hyperex::studio
