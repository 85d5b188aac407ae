// A server without sockets over a folder of its own.
#pragma once

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "app.hpp"
#include "files/temporary_folder.hpp"
#include "outrider/jobs/catalog.hpp"
#include "support/eventually.hpp"

namespace outrider::server {

class AppTest : public ::testing::Test {
 protected:
  AppTest() : own_(std::move(*TemporaryFolder::make())), home_(own_.path()) {}

  [[nodiscard]] std::filesystem::path path(const std::string& name) const { return home_ / name; }

  void write(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories(path(name).parent_path());
    std::ofstream(path(name)) << text;
  }

  /// A program that stands in for the tool: a shell script that sees `run SCENARIO --json --out FOLDER`.
  void write_tool(const std::string& script) {
    write("tool", "#!/bin/sh\n" + script);
    ::chmod(path("tool").c_str(), 0700);
    settings_.runs.tool = path("tool").string();
  }

  App& app() {
    if (!app_) app_ = std::make_unique<App>(*Folder::open(home_.string()), settings_);
    return *app_;
  }

  Response ask(const std::string& method, const std::string& where, const std::string& body = {},
               std::map<std::string, std::string> headers = {}) {
    headers.emplace("host", "127.0.0.1:8080");
    if (body.starts_with('{')) headers.emplace("content-type", "application/json");
    const std::size_t question = std::min(where.find('?'), where.size());
    const std::string query = question == where.size() ? "" : where.substr(question + 1);
    return app().answer({method, where.substr(0, question), query, std::move(headers), body});
  }

  /// Returns the bytes that are sent, from memory or from the disk.
  static std::string body_of(const Response& response) {
    return response.file ? response.file->part(0, response.file->bytes()) : response.body;
  }

  Json json(const std::string& method, const std::string& where, const std::string& body = {},
            int status = 200) {
    const Response response = ask(method, where, body);
    EXPECT_EQ(response.status, status) << response.body;
    return Json::parse(body_of(response));
  }

  /// The run once its state is one of those that last.
  Json ended(const std::string& id) {
    Json run;
    EXPECT_TRUE(testing::eventually([&] {
      run = json("GET", "/api/v1/runs/" + id);
      return run["state"] != "queued" && run["state"] != "running";
    })) << "run "
        << id << " does not end";
    return run;
  }

  TemporaryFolder own_;
  std::filesystem::path home_;
  /// Files are read here, not in a process that is confined: tests/cli/serve_confinement_test.py tests that
  /// one. Counts the questions.
  ReadFiles read_here() {
    return [this](const Folder& folder, const Json& question, const std::stop_token&) {
      ++questions_;
      EXPECT_EQ(::fchdir(folder.gate().descriptor()), 0);
      return answer_reading(question, folder, jobs());
    };
  }
  int questions_ = 0;

  AppSettings settings_{"1.2.3", "", jobs(), {}, {}, read_here()};
  std::unique_ptr<App> app_;
};

}  // namespace outrider::server
