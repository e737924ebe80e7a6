// SPDX-License-Identifier: GPL-3.0-or-later
// Hostile and broken clients: each leaves the server alive and the user's page connected.
#include "server.hpp"

#include <gmock/gmock.h>
#include <sys/resource.h>

#include <atomic>
#include <boost/asio.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <csignal>
#include <thread>

#include "hyperex/core/files.hpp"
#include "support/test_file.hpp"

namespace hyperex::studio {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using tcp = asio::ip::tcp;
using testing::HasSubstr;

constexpr const char* kToken = "0123456789abcdef0123456789abcdef";

class StudioServer : public testing::Test {
 protected:
  StudioServer() {
    ServerOptions options;
    options.page = "<!doctype html><title>page</title>";
    options.token = kToken;
    options.uploads = folder_.path();
    options.longest_message = 1U << 20U;
    options.longest_upload = 1U << 20U;
    options.most_waiting = 8U << 20U;
    options.most_connections = 8;
    server_ = std::make_unique<Server>(
        options, ServerEvents{[this](const std::string& text) {
                                ++requests_;
                                server_->send("echo " + text.substr(0, 20), false);
                              },
                              [this](const std::string&) { ++uploads_; }});
    thread_ = std::thread([this] { server_->run(); });
  }
  ~StudioServer() override {
    server_->stop();
    thread_.join();
  }

  std::string own() const { return "127.0.0.1:" + std::to_string(server_->port()); }
  tcp::socket connected() {
    tcp::socket socket(io_);
    socket.connect({asio::ip::address_v4::loopback(), server_->port()});
    return socket;
  }
  /// What the server says to these bytes, until it ends the connection.
  std::string answer_to(const std::string& bytes) {
    tcp::socket socket = connected();
    beast::error_code error;
    asio::write(socket, asio::buffer(bytes), error);
    std::string answer;
    asio::read(socket, asio::dynamic_buffer(answer), error);
    return answer;
  }
  std::string get(const std::string& target, const std::string& host) {
    return answer_to("GET " + target + " HTTP/1.1\r\nHost: " + host + "\r\n\r\n");
  }
  std::string post(const std::string& name, const std::string& body, const std::string& more) {
    return answer_to("POST /upload/" + name + " HTTP/1.1\r\nHost: " + own() +
                     "\r\nOrigin: http://" + own() + "\r\n" + more +
                     "Content-Length: " + std::to_string(body.size()) + "\r\n\r\n" + body);
  }
  static std::string bearer() { return std::string("Authorization: Bearer ") + kToken + "\r\n"; }

  using Socket = websocket::stream<tcp::socket>;
  Socket socket_from(const std::string& origin, beast::error_code& error,
                     const std::string& path = "/socket") {
    Socket socket(connected());
    socket.set_option(websocket::stream_base::decorator([&](websocket::request_type& request) {
      if (!origin.empty()) request.set(http::field::origin, origin);
    }));
    socket.handshake(own(), path, error);
    return socket;
  }
  Socket let_in() {
    beast::error_code error;
    Socket socket = socket_from("http://" + own(), error);
    EXPECT_FALSE(error) << error.message();
    say(socket, std::string(R"({"id":1,"do":"hello","token":")") + kToken + "\",\"version\":1}");
    EXPECT_EQ(heard(socket), "echo {\"id\":1,\"do\":\"hello\"");
    return socket;
  }
  static void say(Socket& socket, const std::string& text) {
    beast::error_code error;
    socket.write(asio::buffer(text), error);
  }
  /// Empty where the socket is closed.
  static std::string heard(Socket& socket) {
    beast::flat_buffer buffer;
    beast::error_code error;
    socket.read(buffer, error);
    return error ? "" : beast::buffers_to_string(buffer.data());
  }

  const TestFolder folder_;
  std::atomic<int> requests_ = 0, uploads_ = 0;
  std::unique_ptr<Server> server_;
  std::thread thread_;
  asio::io_context io_;
};

TEST_F(StudioServer, ServesOnePageWithItsPolicy) {
  const std::string page = get("/", own());
  EXPECT_THAT(page, HasSubstr("200 OK"));
  EXPECT_THAT(page, HasSubstr("<title>page</title>"));
  EXPECT_THAT(page, HasSubstr("connect-src 'self' ws://" + own()));
  EXPECT_THAT(page, HasSubstr("nosniff"));
  EXPECT_THAT(page, testing::Not(HasSubstr("Access-Control")));
  for (const char* target : {"/index.html", "/../../etc/passwd", "/upload", "//", "/%2e%2e/x"})
    EXPECT_THAT(get(target, own()), HasSubstr("404")) << target;
  EXPECT_THAT(answer_to("DELETE / HTTP/1.1\r\nHost: " + own() + "\r\n\r\n"), HasSubstr("405"));
  EXPECT_THAT(server_->address(), HasSubstr(std::string("/#") + kToken));
}

TEST_F(StudioServer, AnswersNoOtherHostAndNoOtherOrigin) {
  for (const char* host : {"evil.example", "127.0.0.1", "localhost:1"})
    EXPECT_THAT(get("/", host), HasSubstr("403")) << host;
  for (const char* origin : {"", "http://evil.example", "null", "http://127.0.0.1:1"}) {
    beast::error_code error;
    socket_from(origin, error);
    EXPECT_TRUE(error) << origin;
  }
  beast::error_code error;
  socket_from("http://" + own(), error, "/other");
  EXPECT_TRUE(error);
}

TEST_F(StudioServer, LetsNobodyInWithoutTheToken) {
  for (const std::string& first :
       {std::string(R"({"id":1,"do":"hello","token":"guess","version":1})"), std::string("{}"),
        std::string("hello"), std::string(R"({"id":1,"do":"undo"})"), std::string(5000, 'x'),
        std::string(R"({"id":1,"do":"hello","token":["0123456789abcdef0123456789abcdef"]})")}) {
    beast::error_code error;
    Socket socket = socket_from("http://" + own(), error);
    ASSERT_FALSE(error);
    say(socket, first);
    EXPECT_EQ(heard(socket), "") << first.substr(0, 60);
  }
  EXPECT_EQ(requests_, 0);
  let_in();
}

TEST_F(StudioServer, ANewPageTakesOver) {
  Socket first = let_in();
  Socket second = let_in();
  EXPECT_EQ(heard(first), "");
  say(second, "again");
  EXPECT_EQ(heard(second), "echo again");
}

TEST_F(StudioServer, DropsWhoSendsTooMuch) {
  Socket user = let_in();
  say(user, std::string((1U << 20U) + 1, 'x'));
  EXPECT_EQ(heard(user), "");
  Socket flood = let_in();
  for (int i = 0; i < 10000; ++i) say(flood, "{}");
  int answers = 0;
  while (!heard(flood).empty()) ++answers;
  EXPECT_LT(answers, 2000);
  let_in();
}

TEST_F(StudioServer, DropsASlowReader) {
  Socket slow = let_in();
  for (int i = 0; i < 64; ++i) server_->send(std::string(1U << 20U, 'x'), true);
  Socket next = let_in();
  say(next, "still there");
  EXPECT_EQ(heard(next), "echo still there");
}

TEST_F(StudioServer, OfMessagesThatReplaceEachOtherTheLastGoes) {
  Socket user = let_in();
  server_->send(std::string(4U << 20U, 'a'), true);  // fills the way
  for (int i = 0; i < 50; ++i) server_->send("shape " + std::to_string(i), false, "shape");
  EXPECT_EQ(heard(user).size(), 4U << 20U);
  std::string last;
  int count = 0;
  do {
    last = heard(user);
    ++count;
  } while (last != "shape 49");
  EXPECT_LT(count, 50);
}

TEST_F(StudioServer, TornFramesAndHeadsHarmNoOne) {
  Socket user = let_in();
  for (const std::string& bytes :
       {std::string("\x16\x03\x01\x02", 4), std::string("GET / HTTP/1.1\r\nHost: "),
        std::string("GET / HTTP/9.9\r\n\r\n"), std::string(100000, 'A'),
        "GET / HTTP/1.1\r\nHost: " + own() + "\r\nX: " + std::string(50000, 'y') + "\r\n\r\n",
        std::string("POST /upload/x HTTP/1.1\r\nContent-Length: -5\r\n\r\n")}) {
    tcp::socket socket = connected();
    beast::error_code error;
    asio::write(socket, asio::buffer(bytes), error);
    socket.close();
  }
  {
    beast::error_code error;
    Socket torn = socket_from("http://" + own(), error);
    asio::write(torn.next_layer(), asio::buffer(std::string("\xff\xff\xff\xff\xff\xff", 6)), error);
    torn.next_layer().close();
  }
  say(user, "still here");
  EXPECT_EQ(heard(user), "echo still here");
}

TEST_F(StudioServer, SilentConnectionsGiveWayToWhoComesAndTheUsersPageStays) {
  Socket user = let_in();
  beast::error_code error;
  std::vector<tcp::socket> idle;
  for (int i = 0; i < 40; ++i) idle.push_back(connected());
  std::vector<Socket> without_hello;
  for (int i = 0; i < 20; ++i) without_hello.push_back(socket_from("http://" + own(), error));
  // All places are taken by those who say nothing, and stay so.
  EXPECT_THAT(get("/", own()), HasSubstr("200 OK"));
  say(user, "one");
  EXPECT_EQ(heard(user), "echo one");
  Socket next = let_in();
  EXPECT_EQ(heard(user), "") << "taken over, not shut out";
  for (int i = 0; i < 40; ++i) idle.push_back(connected());
  EXPECT_THAT(get("/", own()), HasSubstr("200 OK"));
  say(next, "two");
  EXPECT_EQ(heard(next), "echo two");
}

TEST_F(StudioServer, WhatIsGoneOfTheUploadsMakesRoom) {
  const std::string most(1U << 20U, 'x');
  EXPECT_THAT(post("a.ply", most, bearer()), HasSubstr("200"));
  EXPECT_THAT(post("b.ply", most, bearer()), HasSubstr("200"));
  EXPECT_THAT(post("c.ply", "x", bearer()), HasSubstr("413"));
  std::filesystem::remove(folder_.path() / "a.ply");
  EXPECT_THAT(post("c.ply", "x", bearer()), HasSubstr("200"));
}

TEST_F(StudioServer, SaysThatTheDiskTakesNoMore) {
  std::signal(SIGXFSZ, SIG_IGN);
  struct rlimit before {};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  const struct rlimit little { 4096, before.rlim_max };
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &little), 0);
  const std::string answer = post("a.ply", std::string(300000, 'x'), bearer());
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &before), 0);
  EXPECT_THAT(answer, HasSubstr("507"));
  EXPECT_THAT(answer, HasSubstr("a.ply: cannot be written (File too large)"));
  EXPECT_TRUE(std::filesystem::is_empty(folder_.path()));
  EXPECT_THAT(post("a.ply", "x", bearer()), HasSubstr("200"));
}

TEST_F(StudioServer, TakesUploadsOfItsPageAlone) {
  EXPECT_THAT(post("me%20too.ply", "ply\n", bearer()), HasSubstr(R"({"name":"me too.ply"})"));
  EXPECT_EQ(read_file(folder_.path() / "me too.ply"), "ply\n");
  EXPECT_EQ(uploads_, 1);
  EXPECT_THAT(post("me%20too.ply", "other", bearer()), HasSubstr(R"({"name":"me too-2.ply"})"));
  EXPECT_EQ(read_file(folder_.path() / "me too.ply"), "ply\n") << "what a scene may name stays";
  EXPECT_THAT(post("a.ply", "x", ""), HasSubstr("403"));
  EXPECT_THAT(post("a.ply", "x", "Authorization: Bearer guess\r\n"), HasSubstr("403"));
  for (const char* name :
       {"..%2f..%2fx", "%2e%2e", ".x", "a%2fb", "a%00b", "%zz", "%ff.obj", "%c2%85", ""})
    EXPECT_THAT(post(name, "x", bearer()), HasSubstr("400")) << name;
  EXPECT_THAT(post("big.ply", std::string((1U << 20U) + 1, 'x'), bearer()), HasSubstr("413"));
  EXPECT_THAT(answer_to("POST /upload/huge HTTP/1.1\r\nHost: " + own() + "\r\nOrigin: http://" +
                        own() + "\r\n" + bearer() + "Content-Length: 2147483648\r\n\r\n"),
              HasSubstr("413"));
  const auto parts = [&] {
    for (const auto& file : std::filesystem::directory_iterator(folder_.path()))
      if (file.path().filename().string().starts_with(".part-")) return true;
    return false;
  };
  const auto wait_until_parts = [&](bool there) {
    for (int i = 0; i < 100 && parts() != there; ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    return parts() == there;
  };
  // Torn in the middle, once it has begun to be written: nothing is left of it.
  {
    tcp::socket socket = connected();
    asio::write(socket, asio::buffer("POST /upload/torn.ply HTTP/1.1\r\nHost: " + own() +
                                     "\r\nOrigin: http://" + own() + "\r\n" + bearer() +
                                     "Content-Length: 1000\r\n\r\nhalf"));
    EXPECT_TRUE(wait_until_parts(true));
  }
  EXPECT_TRUE(wait_until_parts(false));
  int files = 0;
  for ([[maybe_unused]] const auto& file : std::filesystem::directory_iterator(folder_.path()))
    ++files;
  EXPECT_EQ(files, 2);
  EXPECT_EQ(uploads_, 2);
}

}  // namespace
}  // namespace hyperex::studio
