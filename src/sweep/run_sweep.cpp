#include "outrider/sweep/run_sweep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <filesystem>
#include <future>
#include <mutex>
#include <system_error>

#include "outrider/core/parallel.hpp"
#include "outrider/io/files/file_lock.hpp"
#include "outrider/io/files/files.hpp"
#include "outrider/io/scenario/scenario.hpp"
#include "outrider/job/clock.hpp"
#include "outrider/job/write_run.hpp"

namespace outrider {
namespace {

namespace fs = std::filesystem;

std::string lock_of(const std::string& path) { return path + ".lock"; }
void remove_lock(const std::string& path) {
  std::error_code ignored;
  fs::remove(lock_of(path), ignored);
}

/// Returns true if the folder has something that no sweep writes before its manifest.
bool has_other_files(const std::string& folder) {
  std::error_code error;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    const std::string name = it->path().filename().string();
    if (!name.starts_with('.') && name != "manifest.json") return true;
  }
  return false;
}

/// Writes what a run left, from its log in memory.
Status keep(Run& run, const std::string& folder, const std::string& scenario) {
  RunLog file(folder, scenario);
  run.log.add_sink(file);
  const auto written = write_run(run, file, folder);
  run.log.remove_sink(file);
  if (!written) return pass_on(written);
  return {};
}

SweepResult refusal(SweepRun run, const Fault& fault) {
  const char* status = "refused";
  if (is_answer(fault)) status = "not_done";
  if (fault.code == FaultCode::cancelled) status = "cancelled";
  return {.run = std::move(run), .status = status, .reason = to_string(fault)};
}

Outcome<SweepResult> run_task_of(const Sweep& sweep, const SweepRun& given, const SweepWork& work,
                                 const std::stop_token& stop, PlanCache* plans) {
  const auto task = sweep.job.blank();
  if (auto ok = read_scenario(*task, sweep.request.scenario); !ok) return refusal(given, ok.error());
  if (auto ok = change(*task, changes_of(sweep, given)); !ok) return refusal(given, ok.error());
  auto run = run_task(sweep.job, *task, {.stop = stop, .plans = plans});
  if (!run) return refusal(given, run.error());
  SweepResult result{given, run->report.status, run->report.reason, run->report.metrics};
  if (work.keep_failures && result.status != "done" && !stop.stop_requested()) {
    auto kept =
        keep(*run, fmt::format("{}/failures/{}", work.folder, given.number), scenario_text(task->options()));
    if (!kept) return pass_on(kept);
  }
  return result;
}

/// The progress of a process. Thread rule: any thread.
class Counter {
 public:
  Counter(const SweepWatch& watch, std::uint64_t left) : watch_(watch), begin_s_(wall_s()) {
    progress_.left = left;
  }
  void add(double run_s) {
    const std::lock_guard lock(mutex_);
    ++progress_.done;
    progress_.left -= std::min<std::uint64_t>(1, progress_.left);
    progress_.run_s += run_s;
    progress_.run_squares += run_s * run_s;
    progress_.elapsed_s = wall_s() - begin_s_;
    if (watch_.progress) watch_.progress(progress_);
  }
  /// Leaves out the runs of a chunk that another process computes.
  void skip(std::uint64_t runs) {
    const std::lock_guard lock(mutex_);
    progress_.left -= std::min(runs, progress_.left);
  }

 private:
  const SweepWatch& watch_;
  double begin_s_;
  std::mutex mutex_;
  SweepProgress progress_;
};

/// Writes a chunk while the next one is computed, since a disk takes some 10 ms for it.
class ChunkWriter {
 public:
  /// Begins to write the chunk; takes its lock away then. Fault: that of the chunk before.
  Status write(const std::string& path, std::string text, FileLock lock) {
    auto before = finish();
    writing_ = std::async(std::launch::async, [path, text = std::move(text), held = std::move(lock)] {
      auto written = write_file(path, text);
      remove_lock(path);
      return written;
    });
    return before;
  }
  /// Waits for the last chunk.
  Status finish() { return writing_.valid() ? writing_.get() : Status(); }

 private:
  std::future<Status> writing_;  // its destructor waits
};

/// Returns the text of the chunk.
Outcome<std::string> compute_chunk(const Sweep& sweep, std::uint64_t chunk, const std::string& origin,
                                   const SweepWork& work, const SweepWatch& watch, PlanCache& plans,
                                   Counter& counter) {
  const std::uint64_t first = sweep.begin_of(chunk);
  std::vector<SweepResult> results(sweep.begin_of(chunk + 1) - first);
  std::vector<Status> kept(results.size());
  const bool whole = parallel_for(results.size(), watch.stop, [&](std::size_t i) {
    const double begin_s = wall_s();
    isolated([&] {
      auto result = run_one(sweep, first + i, work, watch.stop, &plans);
      result ? void(results[i] = std::move(*result)) : void(kept[i] = pass_on(result));
    });
    counter.add(wall_s() - begin_s);
  });
  if (const auto failed = std::ranges::find_if_not(kept, &Status::has_value); failed != kept.end()) {
    return pass_on(*failed);
  }
  if (!whole) return fault(FaultCode::cancelled, "it was cancelled; the same command continues it");
  return chunk_text(sweep, results, origin);
}

}  // namespace

std::optional<TimeLeft> time_left(const SweepProgress& progress) {
  constexpr std::uint64_t least = 8;
  if (progress.done < least || progress.run_s <= 0.0 || progress.elapsed_s <= 0.0) return std::nullopt;
  const auto n = static_cast<double>(progress.done), left = static_cast<double>(progress.left);
  const double mean = progress.run_s / n;
  const double variance = std::max(0.0, (progress.run_squares - n * mean * mean) / (n - 1.0));
  // The sum of those left varies about left x mean, and the mean itself is known from n runs only.
  const double deviation = std::sqrt(variance * (left + left * left / n));
  const double at_once = progress.run_s / progress.elapsed_s;  // runs that go on at the same time
  return TimeLeft{std::max(0.0, left * mean - 2.0 * deviation) / at_once,
                  (left * mean + 2.0 * deviation) / at_once};
}

Status begin_sweep(const Manifest& manifest, const std::string& folder) {
  const std::string path = manifest_path(folder);
  if (!file_exists(path)) {
    if (has_other_files(folder)) {
      return bad_input("it holds other files than those of a sweep; name an empty folder", folder);
    }
    if (auto ok = make_folder(folder); !ok) return ok;
    if (auto ok = write_file(path, manifest_text(manifest)); !ok) return ok;
  } else {
    const auto begun = manifest_in(folder);
    if (!begun) return pass_on(begun);
    if (auto ok = check_same(*begun, manifest, path); !ok) return ok;
  }
  return make_folder(folder + "/chunks");
}

Outcome<SweepResult> run_one(const Sweep& sweep, std::uint64_t number, const SweepWork& work,
                             const std::stop_token& stop, PlanCache* plans) {
  const SweepRun given = run_of(sweep, number);
  try {
    return run_task_of(sweep, given, work, stop, plans);
  } catch (const std::exception& broken) {
    return SweepResult{
        .run = given, .status = "bug", .reason = fmt::format("this is a bug: {}", broken.what())};
  }
}

Outcome<std::vector<std::uint64_t>> compute_chunks(const Sweep& sweep, const SweepWork& work,
                                                   const SweepWatch& watch) {
  const auto manifest = manifest_in(work.folder);
  if (!manifest) return pass_on(manifest);
  const std::string origin = manifest_hash(*manifest);
  std::uint64_t left = 0;
  for (std::uint64_t chunk = work.first_chunk; chunk < work.end_chunk && !watch.stop.stop_requested();
       ++chunk) {
    const std::string path = chunk_path(work.folder, chunk);
    if (!file_exists(path)) {
      left += sweep.begin_of(chunk + 1) - sweep.begin_of(chunk);
      continue;
    }
    auto text = read_file(path);
    if (!text) return pass_on(text);
    if (auto ok = check_origin(sweep, chunk, origin, *text, path); !ok) return pass_on(ok);
  }
  Counter counter(watch, left);
  PlanCache plans;
  std::vector<std::uint64_t> others;
  ChunkWriter writer;
  for (std::uint64_t chunk = work.first_chunk; chunk < work.end_chunk; ++chunk) {
    const std::string path = chunk_path(work.folder, chunk);
    if (file_exists(path)) {
      remove_lock(path);  // whoever was killed between the chunk and its lock
      continue;
    }
    auto lock = FileLock::take(lock_of(path));
    if (!lock) return pass_on(lock);
    const bool is_done = file_exists(path);  // by another one, just now
    if (!lock->held() || is_done) {
      if (!lock->held()) others.push_back(chunk);
      if (lock->held()) remove_lock(path);
      counter.skip(sweep.begin_of(chunk + 1) - sweep.begin_of(chunk));
      continue;
    }
    auto text = compute_chunk(sweep, chunk, origin, work, watch, plans, counter);
    if (!text) {
      remove_lock(path);
      return pass_on(text);
    }
    if (auto ok = writer.write(path, std::move(*text), std::move(*lock)); !ok) return pass_on(ok);
  }
  if (auto ok = writer.finish(); !ok) return pass_on(ok);
  return others;
}

std::vector<std::uint64_t> missing_chunks(const Sweep& sweep, const std::string& folder) {
  std::vector<std::uint64_t> missing;
  for (std::uint64_t chunk = 0; chunk < sweep.chunks(); ++chunk) {
    if (!file_exists(chunk_path(folder, chunk))) missing.push_back(chunk);
  }
  return missing;
}

}  // namespace outrider
