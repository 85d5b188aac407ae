// A job whose runs cost nothing, and sweeps of it: y = 2 x + a random number below 1.
#pragma once

#include <gtest/gtest.h>

#include <unistd.h>

#include <filesystem>
#include <stdexcept>

#include "outrider/core/rng.hpp"
#include "outrider/io/files/files.hpp"
#include "outrider/sweep/merge_chunks.hpp"
#include "outrider/sweep/run_sweep.hpp"

namespace outrider::testing {

struct SweepTask final : JobTask {
  SweepTask() : JobTask("toy") {}
  Outcome<Warnings> load() override {
    if (x == 0.0) return fault(FaultCode::no_path, "there is no path to 0");
    if (file.empty()) return Warnings{};
    const auto text = read_file(file);
    if (!text) return pass_on(text);
    return Warnings{};
  }
  Status run(Run& run, const RunWatch&) override {
    if (x > 9.5) throw std::runtime_error("x is too large");
    if (x < 0.5) return bad_input("x '" + std::to_string(x) + "' is too small", "x");
    const double y = 2.0 * x + Rng(static_cast<std::uint64_t>(seed)).uniform();
    run.report.status = y > 15.0 ? "not_done" : "done";
    if (y > 15.0) run.report.reason = "y is " + std::to_string(y) + ", above 15";
    run.report.metrics = {{"y", y}};
    if (mode == "b") run.report.metrics.emplace_back("twice", 2.0 * y);
    return {};
  }
  std::vector<OptionGroup> describe() override {
    return {{"",
             "all",
             {{"seed", "", 0, 1e15, "seed", &seed},
              {"x", "m", 0, 10, "a number", &x},
              {"mode", "", 0, 0, "a word", &mode},
              file_option("file", "a file", &file)}}};
  }
  std::int64_t seed = 1;
  double x = 1.0;
  std::string mode = "a", file;
};

inline const std::vector<Job>& toy_jobs() {
  static const std::vector<Job> all = {
      {.name = "toy", .sentence = "Doubles x.", .blank = [] { return std::make_unique<SweepTask>(); }}};
  return all;
}

/// A folder with a scenario of the job, removed in the end.
class SweepFolder : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    home_ = std::filesystem::temp_directory_path() /
            ("outrider-sweep-" + std::to_string(::getpid()) + "-" + test->name());
    std::filesystem::remove_all(home_);
    std::filesystem::create_directories(home_);
    write("toy.yaml", "job: toy\nx: 2\nfile: input.txt\n");
    write("input.txt", "a\n");
  }
  void TearDown() override { std::filesystem::remove_all(home_); }

  [[nodiscard]] std::string path(const std::string& name) const { return (home_ / name).string(); }
  void write(const std::string& name, const std::string& text) const {
    ASSERT_TRUE(write_file(path(name), text));
  }
  [[nodiscard]] Sweep sweep(SweepRequest request) const {
    request.scenario = path("toy.yaml");
    auto made = prepare_sweep(toy_jobs(), request);
    EXPECT_TRUE(made) << to_string(made.error());
    return *made;
  }
  [[nodiscard]] Manifest manifest(const Sweep& of) const {
    auto made = make_manifest(of, "1.2.3");
    EXPECT_TRUE(made) << to_string(made.error());
    return *made;
  }
  /// Makes the table of a folder, and returns its hash.
  [[nodiscard]] Outcome<std::string> merge(const Sweep& of, const std::string& folder) const {
    ChunkReader chunks(of, path(folder));
    return merge_chunks(chunks);
  }
  /// Computes the whole sweep in a folder and returns its table.
  [[nodiscard]] std::string table(const Sweep& of, const std::string& folder) const {
    EXPECT_TRUE(begin_sweep(manifest(of), path(folder)));
    EXPECT_TRUE(compute_chunks(of, {.folder = path(folder), .end_chunk = of.chunks()}));
    const auto hash = merge(of, folder);
    EXPECT_TRUE(hash) << to_string(hash.error());
    return read_file(path(folder + "/table.csv")).value_or("");
  }

  std::filesystem::path home_;
};

}  // namespace outrider::testing
