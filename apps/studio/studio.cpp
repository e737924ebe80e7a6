// SPDX-License-Identifier: GPL-3.0-or-later
#include "studio.hpp"

#include <fmt/format.h>
#include <spawn.h>
#include <spdlog/spdlog.h>

#include <chrono>
#include <cstdlib>
#include <iostream>
#include <thread>

#include "hyperex/core/error.hpp"
#include "hyperex/core/files.hpp"
#include "hyperex/core/interrupt.hpp"
#include "hyperex/report/page_template.hpp"
#include "request_queue.hpp"
#include "server.hpp"
#include "session.hpp"
#include "session_folder.hpp"
#include "token.hpp"

extern char** environ;

namespace hyperex::studio {

namespace {

/// Writes a page that redirects to the address and that only this user can read, and returns its
/// URL. Other users of the machine can see a command line, and would see the token in it.
std::string redirect_page(const std::string& address, const fs::path& folder) {
  const fs::path file = folder / "open.html";
  write_file_atomically(file, [&](std::ostream& out) {
    out << "<!doctype html><meta http-equiv=\"refresh\" content=\"0;url=" << address << "\">\n";
  });
  fs::permissions(file, fs::perms::owner_read | fs::perms::owner_write);
  return "file://" + file.string();
}

/// Uses the desktop's opener, which may be missing.
void open_browser(std::string address) {
  std::string program = "xdg-open";
  char* arguments[] = {program.data(), address.data(), nullptr};
  pid_t child = 0;
  posix_spawn_file_actions_t quiet;
  posix_spawn_file_actions_init(&quiet);
  posix_spawn_file_actions_addopen(&quiet, 1, "/dev/null", 1, 0);
  posix_spawn_file_actions_addopen(&quiet, 2, "/dev/null", 1, 0);
  posix_spawnattr_t own_session;  // so that Ctrl+C here does not end the browser
  posix_spawnattr_init(&own_session);
  posix_spawnattr_setflags(&own_session, POSIX_SPAWN_SETSID);
  if (posix_spawnp(&child, program.c_str(), &quiet, &own_session, arguments, environ) != 0)
    spdlog::info("no browser could be opened: open the address yourself");
  posix_spawnattr_destroy(&own_session);
  posix_spawn_file_actions_destroy(&quiet);
}

/// A slider that is being dragged moves again within this time, or its release sends another
/// request. Until then computing the whole motion would only delay the next shape.
constexpr std::chrono::milliseconds kHeldFor{500};

/// Answers requests of the queue, and works while none waits.
void answer_all(RequestQueue& queue, Session& session, Server& server) {
  bool held = false;
  while (!queue.closed()) {
    std::vector<Request> superseded;
    const auto wait = !session.has_work() ? RequestQueue::kForever
                      : held              ? kHeldFor
                                          : std::chrono::milliseconds(0);
    const auto request = queue.pop(wait, superseded);
    held = request && is_live(*request);
    for (const Request& old : superseded)
      server.send(json{{"answer", old.id}, {"superseded", true}}.dump(), false);
    if (request)
      session.answer(*request);
    else if (session.has_work())
      session.work([&] { return !queue.empty() || queue.closed(); });
  }
}

/// Puts a message of the page into the queue. A message is handled here only if it is not a valid
/// request, or must neither wait nor interrupt the computation.
void receive(const std::string& text, RequestQueue& queue, Session& session, Server& server) {
  std::int64_t id = -1;
  try {
    Request request = read_request(text, id);
    if (request.name == "live_drawn") {
      session.drawn(request.fields.at("frame"));
      server.send(json{{"answer", id}}.dump(), false);
    } else if (!queue.push(std::move(request))) {
      throw InputError("too many requests wait");
    }
  } catch (const InputError& error) {
    const json answer = {{"answer", id}, {"error", error.what()}};
    server.send(answer.dump(-1, ' ', false, json::error_handler_t::replace), false);
  }
}

SessionOptions session_options(const StudioOptions& options, const SessionFolder& folder,
                               const RequestQueue& queue) {
  return {.started = options.started.empty() ? fs::path() : fs::absolute(options.started),
          .save_into = fs::absolute(options.save_into).lexically_normal(),
          .folder = folder.path(),
          .rescued = folder.rescued(),
          .program = "Hyperex " + options.version,
          .device = options.device,
          .mirrored = options.mirrored,
          .bands = options.bands,
          .kept = options.kept,
          .ending = [&queue] { return queue.closed(); },
          .tell = [](const std::string& text) { spdlog::error("{}", text); }};
}

/// Keeps the session's folder if it contains unsaved work; likewise the rescued one.
void leave_unsaved_work(const Session& session, SessionFolder& folder) {
  if (!session.keeps_rescued()) {
    std::error_code ignored;
    fs::remove_all(folder.rescued(), ignored);
  }
  if (session.saved()) return;
  folder.leave();
  std::cerr << "Unsaved work is kept: the next studio offers to open it.\n";
}

}  // namespace

void make_folder_for_saved_files(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (!fs::is_directory(folder, error))
    throw InputError(folder, "cannot be made: expected a folder for saved files");
}

void run_studio(const StudioOptions& options) {
  if (fs::is_directory(options.started))
    throw InputError(options.started, "is a folder; expected a scene (.toml) or a scan");
  if (!options.started.empty() && !fs::is_regular_file(options.started))
    throw InputError(options.started, "no such file: expected a scene (.toml) or a scan");
  make_folder_for_saved_files(options.save_into);
  const StopOnRequest stop;
  SessionFolder folder;
  RequestQueue queue;
  std::unique_ptr<Server> server;
  std::unique_ptr<Session> session;
  ServerOptions how;
  how.page = report::page_template(report::Page::studio);
  how.token = new_token();
  how.port = options.port;
  how.uploads = folder.path() / "uploads";
  fs::create_directory(how.uploads);
  ServerEvents events;
  events.request = [&](const std::string& text) { receive(text, queue, *session, *server); };
  // Not its name, which may be a patient's.
  events.uploaded = [](const std::string& name) {
    spdlog::info("uploaded: a file of the kind {}", fs::path(name).extension().string());
  };
  server = std::make_unique<Server>(std::move(how), std::move(events));
  session =
      std::make_unique<Session>(session_options(options, folder, queue),
                                [&](std::string message, bool binary, const std::string& replaces) {
                                  server->send(std::move(message), binary, replaces);
                                });
  std::thread network([&] { server->run(); });
  std::thread worker([&] { answer_all(queue, *session, *server); });
  std::cout << server->address() << std::endl;
  std::cerr << "The studio is open at this address, on this machine only; Ctrl+C ends it.\n";
  if (options.open_browser) open_browser(redirect_page(server->address(), folder.path()));
  while (!stop.requested()) std::this_thread::sleep_for(std::chrono::milliseconds(100));
  queue.close();
  worker.join();
  server->stop();
  network.join();
  leave_unsaved_work(*session, folder);
}

}  // namespace hyperex::studio
