// outrider sweep: many runs of one scenario.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/resource.h>
#include <tbb/global_control.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>

#include "commands/commands.hpp"
#include "commands/slurm_script.hpp"
#include "flags.hpp"
#include "output/output.hpp"
#include "output/progress.hpp"
#include "output/terminal.hpp"
#include "outrider/core/text.hpp"
#include "outrider/io/files/files.hpp"
#include "outrider/io/files/text.hpp"
#include "outrider/job/clock.hpp"
#include "outrider/report/run_json.hpp"
#include "outrider/sweep/merge_chunks.hpp"
#include "outrider/sweep/picture.hpp"
#include "outrider/sweep/run_sweep.hpp"
#include "outrider/sweep/summary.hpp"
#include "stop_on_signal.hpp"

namespace outrider::cli {
namespace {

using Json = nlohmann::ordered_json;

/// The values of the flags.
struct SweepFlags {
  std::string input;  ///< scenario, or folder of a sweep
  std::vector<std::string> vary, compare;
  std::int64_t runs = 1, seed = 0, chunk_runs = 1000, threads = 0;
  std::string folder, chunks, keep, emit;
  bool merge = false, json = false;
};

std::vector<OptionGroup> describe(SweepFlags& flags) {
  return {
      {"",
       "what varies",
       {{"runs", "", 1, static_cast<double>(most_sweep_runs), "seeds; each is run at all points of the grid",
         &flags.runs},
        {"seed", "", 0, static_cast<double>(most_seed),
         "seed from which those of the runs and all random values are drawn", &flags.seed}}},
      {"",
       "which part is computed",
       {{"out", "", 0, 0, "folder for the table, its chunks and the summary; unless given, sweep-SCENARIO",
         &flags.folder},
        {"chunks", "", 0, 0, "computes only chunk K, or chunks A..B with both ends", &flags.chunks},
        {"chunk_runs", "", 1, static_cast<double>(most_chunk_runs), "runs in a chunk; the table is the same",
         &flags.chunk_runs},
        {"merge", "", 0, 0, "computes no runs: makes the table of the chunks that others computed",
         &flags.merge},
        choice_option("emit", "computes no runs: writes the script of a job array for a scheduler",
                      &flags.emit, {"slurm"}),
        choice_option("keep", "writes the logs of runs that fail, in the folder failures", &flags.keep,
                      {"failures"}),
        {"threads", "", 0, 1024, "threads to compute with; 0: all; the answer is the same", &flags.threads},
        {"json", "", 0, 0, "print one JSON object on standard output", &flags.json}}}};
}

/// A sweep, and the part of it that this process computes.
struct Plan {
  Sweep sweep;
  Manifest manifest;
  SweepWork work;
};

bool is_folder(const std::string& path) {
  std::error_code error;
  return std::filesystem::is_directory(path, error);
}

/// Returns the request and its folder: as the flags have it, or as it was begun in a folder.
Outcome<SweepRequest> read_request(SweepFlags& flags, const Command& words) {
  if (!is_folder(flags.input)) {
    if (flags.folder.empty()) flags.folder = "sweep-" + std::filesystem::path(flags.input).stem().string();
    return SweepRequest{.scenario = flags.input,
                        .runs = static_cast<std::uint64_t>(flags.runs),
                        .seed = static_cast<std::uint64_t>(flags.seed),
                        .vary = flags.vary,
                        .compare = flags.compare,
                        .chunk_runs = static_cast<std::uint64_t>(flags.chunk_runs)};
  }
  for (const char* flag : {"--runs", "--seed", "--vary", "--compare", "--chunk-runs", "--out"}) {
    if (!words.given(flag)) continue;
    return bad_input("the folder says what its sweep is; leave the flag out, or name the scenario", flag);
  }
  flags.folder = flags.input;
  auto manifest = manifest_in(flags.folder);
  if (!manifest) return pass_on(manifest);
  return manifest->request;
}

/// Reads K or A..B.
Status read_chunks(const std::string& text, const Sweep& sweep, SweepWork& work) {
  work.end_chunk = sweep.chunks();
  if (text.empty()) return {};
  const std::size_t dots = text.find("..");
  const std::string_view all = text;
  const auto first = number<std::uint64_t>(all.substr(0, dots));
  const auto last = dots == std::string::npos ? first : number<std::uint64_t>(all.substr(dots + 2));
  if (!first || !last || *first > *last || *last >= sweep.chunks()) {
    return bad_input(fmt::format("'{}' is not valid; expected K or A..B, of the chunks 0 to {}",
                                 excerpt(text), sweep.chunks() - 1),
                     "--chunks");
  }
  work.first_chunk = *first;
  work.end_chunk = *last + 1;
  return {};
}

Status check(const SweepFlags& flags) {
  const bool emits = !flags.emit.empty();
  if (emits && flags.emit != "slurm" && flags.emit != "chunks") {
    return bad_input(fmt::format("'{}' is not valid; expected chunks or slurm", excerpt(flags.emit)),
                     "--emit");
  }
  if (!flags.keep.empty() && flags.keep != "failures") {
    return bad_input(fmt::format("'{}' is not valid; expected failures", excerpt(flags.keep)), "--keep");
  }
  if ((emits || flags.merge) && !flags.chunks.empty()) {
    return bad_input("no chunks are computed with --merge or --emit; leave one of the flags out", "--chunks");
  }
  if (emits && flags.merge)
    return bad_input("--merge needs chunks that are computed; leave it out", "--merge");
  return {};
}

Outcome<Plan> make_plan(SweepFlags& flags, const Command& words, const std::vector<Job>& jobs) {
  if (auto ok = check(flags); !ok) return pass_on(ok);
  const auto request = read_request(flags, words);
  if (!request) return pass_on(request);
  auto sweep = prepare_sweep(jobs, *request);
  if (!sweep) return pass_on(sweep);
  Plan plan{.sweep = std::move(*sweep), .manifest = {}, .work = {.folder = flags.folder}};
  plan.work.keep_failures = !flags.keep.empty();
  if (auto ok = read_chunks(flags.chunks, plan.sweep, plan.work); !ok) return pass_on(ok);
  if (auto ok = of_flag_out(check_folder(flags.folder)); !ok) return pass_on(ok);
  auto manifest = make_manifest(plan.sweep, OUTRIDER_VERSION);
  if (!manifest) return pass_on(manifest);
  plan.manifest = std::move(*manifest);
  if (auto ok = of_flag_out(begin_sweep(plan.manifest, flags.folder)); !ok) return pass_on(ok);
  return plan;
}

/// Shows how far a sweep is. Thread rule: one at a time, from any thread.
class SweepLine {
 public:
  void show(const SweepProgress& now) {
    constexpr double period_s = 0.25;
    last_ = now;
    if (now.left > 0 && now.elapsed_s < shown_s_ + period_s) return;
    shown_s_ = now.elapsed_s;
    const auto left = time_left(now);
    const std::uint64_t all = now.done + now.left;
    line_.show(
        {.name = fmt::format(
             "{} of {} runs{}", now.done, all,
             left ? fmt::format(", {} to {} left", duration_text(left->low_s), duration_text(left->high_s))
                  : ""),
         .number = 1,
         .steps = 1,
         .part = static_cast<double>(now.done) / static_cast<double>(std::max<std::uint64_t>(1, all))});
  }
  [[nodiscard]] const SweepProgress& last() const { return last_; }

 private:
  Progress line_;
  SweepProgress last_;
  double shown_s_ = 0.0;
};

/// Returns the time and the memory that the work took. They differ from run to run and are only displayed.
Json machine_json(const SweepProgress& progress, double begin_s) {
  rusage used{};
  ::getrusage(RUSAGE_SELF, &used);
  return {{"elapsed_s", wall_s() - begin_s},
          {"computing_s", progress.elapsed_s},
          {"within_runs_s", progress.run_s},
          {"threads", tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism)},
          {"runs", progress.done},
          {"peak_mib", static_cast<double>(used.ru_maxrss) / 1024.0}};
}

/// The answer that is printed at the end.
struct Answer {
  std::string status = "done";
  std::string reason = {};
  std::string text = {};
  std::vector<std::uint64_t> missing = {};
  WrittenFiles files = {};
  Json summary = {};
  std::string table_sha256 = {};
};

std::string list_of(const std::vector<std::uint64_t>& chunks) {
  constexpr std::size_t most = 10;
  const std::vector<std::uint64_t> shown(
      chunks.begin(), chunks.begin() + static_cast<std::ptrdiff_t>(std::min(most, chunks.size())));
  return fmt::format("{}{}", fmt::join(shown, ", "), chunks.size() > most ? ", ..." : "");
}

/// Lists the chunks that are missing, one a line.
Answer emit_chunks(const Plan& plan, const SweepFlags& flags) {
  const auto missing = missing_chunks(plan.sweep, flags.folder);
  return {.text = missing.empty() ? "" : fmt::format("{}\n", fmt::join(missing, "\n")),
          .missing = missing,
          .files = {{"folder", flags.folder}}};
}

Outcome<Answer> emit_slurm(const Plan& plan, const SweepFlags& flags) {
  std::error_code ignored;
  const SweepRequest& request = plan.sweep.request;
  std::vector<std::string> words = {std::filesystem::read_symlink("/proc/self/exe", ignored).string(),
                                    "sweep", request.scenario};
  const auto add = [&](const std::string& flag, const std::string& value) {
    words.insert(words.end(), {flag, value});
  };
  add("--runs", fmt::format("{}", request.runs));
  add("--seed", fmt::format("{}", request.seed));
  for (const std::string& text : request.vary) add("--vary", text);
  for (const std::string& text : request.compare) add("--compare", text);
  add("--chunk-runs", fmt::format("{}", request.chunk_runs));
  add("--out", flags.folder);
  if (!flags.keep.empty()) add("--keep", flags.keep);
  Answer answer;
  const std::string path = flags.folder + "/sweep.sbatch";
  const std::string here = std::filesystem::current_path(ignored).string();
  if (auto ok = write_file(path, slurm_script(words, here, flags.folder, plan.sweep.chunks())); !ok) {
    return pass_on(ok);
  }
  answer.text = fmt::format("{} chunks; submit them with: sbatch {}\n", plan.sweep.chunks(), path);
  answer.files = {{"script", path}};
  return answer;
}

/// Makes the table, the summary and what shows it.
Outcome<Answer> conclude(const Plan& plan) {
  const std::string& folder = plan.work.folder;
  ChunkReader chunks(plan.sweep, folder);
  const auto hash = merge_chunks(chunks);
  if (!hash) return pass_on(hash);
  Answer answer;
  if (hash->empty()) {
    answer.reason = "another process is making the table";
    answer.text = answer.reason + "\n";
    return answer;
  }
  const auto summary = summarise(chunks);
  if (!summary) return pass_on(summary);
  answer.summary = Json::parse(summary_json(plan.sweep, *summary));
  answer.table_sha256 = *hash;
  answer.text = summary_text(plan.sweep, *summary);
  const auto picture = sweep_picture(chunks, *summary);
  if (!picture) return pass_on(picture);
  const std::string title = fmt::format("{}: {} runs", plan.sweep.job.name, plan.sweep.total);
  const std::vector<NamedContent> files = {{folder + "/sweep.svg", *picture},
                                           {folder + "/sweep.html", sweep_page(title, *picture, answer.text)},
                                           {folder + "/summary.json", json_text(answer.summary, 1) + "\n"}};
  if (auto ok = outrider::write_files(files); !ok) return pass_on(ok);
  answer.files = {{"table", folder + "/table.csv"},
                  {"summary", files[2].path},
                  {"picture", files[0].path},
                  {"page", files[1].path}};
  return answer;
}

Answer chunks_so_far(const Plan& plan, const std::vector<std::uint64_t>& missing, const std::string& reason) {
  return {.reason = reason,
          .text = fmt::format("{} of {} chunks are there{}{}\n", plan.sweep.chunks() - missing.size(),
                              plan.sweep.chunks(), reason.empty() ? "" : "; ", reason),
          .missing = missing};
}

Outcome<Answer> compute(const Plan& plan, const SweepFlags& flags, const SweepWatch& watch) {
  const auto others = compute_chunks(plan.sweep, plan.work, watch);
  if (!others) return pass_on(others);
  const auto missing = missing_chunks(plan.sweep, flags.folder);
  if (missing.empty() && flags.chunks.empty()) return conclude(plan);
  Answer answer = chunks_so_far(
      plan, missing,
      others->empty() ? "" : fmt::format("other processes are computing chunks {}", list_of(*others)));
  if (missing.empty())
    answer.text += fmt::format("outrider sweep {} --merge makes the table\n", flags.folder);
  return answer;
}

Outcome<Answer> act(const Plan& plan, const SweepFlags& flags, const SweepWatch& watch) {
  if (flags.emit == "chunks") return emit_chunks(plan, flags);
  if (flags.emit == "slurm") return emit_slurm(plan, flags);
  if (!flags.merge) return compute(plan, flags, watch);
  if (const auto missing = missing_chunks(plan.sweep, flags.folder); !missing.empty()) {
    return bad_input(fmt::format("chunks are missing: {}; compute them, without --merge", list_of(missing)),
                     flags.folder);
  }
  return conclude(plan);
}

void print(const Plan& plan, const Answer& answer, const SweepFlags& flags, const Json& machine) {
  if (!flags.json) {
    show("{}", answer.text);
    if (flags.emit == "chunks") return;
    if (!answer.files.empty()) show("\n");
    for (const auto& [name, path] : answer.files) show("  {:<10} {}\n", name, path);
    return;
  }
  Json files = Json::object();
  for (const auto& [name, path] : answer.files) files[name] = path;
  cli::print({{"status", answer.status},
              {"job", plan.sweep.job.name},
              {"reason", answer.reason},
              {"metrics",
               {{"runs", plan.sweep.total},
                {"chunks", plan.sweep.chunks()},
                {"missing_chunks", answer.missing.size()}}},
              {"missing", answer.missing},
              {"table_sha256", answer.table_sha256.empty() ? Json() : Json(answer.table_sha256)},
              {"summary", answer.summary},
              {"machine", machine},
              {"files", files}});
}

int execute(SweepFlags& flags, const Command& words, const std::vector<Job>& jobs,
            const std::stop_token& stop) {
  const double begin_s = wall_s();
  const bool json = words.given("--json");
  if (auto ok = apply_flags(words, describe(flags)); !ok) return print_fault(ok.error(), json);
  std::optional<tbb::global_control> limit;
  if (flags.threads > 0) {
    limit.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(flags.threads));
  }
  const auto plan = make_plan(flags, words, jobs);
  if (!plan) return print_fault(plan.error(), json);
  std::optional<HardStop> hard(std::in_place, stop, [&] {
    print(*plan,
          chunks_so_far(*plan, missing_chunks(plan->sweep, flags.folder),
                        "it was cancelled in the middle of a computation that cannot be interrupted"),
          flags, {});
    std::fflush(stdout);
    std::_Exit(job_done);
  });
  std::optional<SweepLine> line(std::in_place);
  const auto answer = act(*plan, flags, {stop, [&](const SweepProgress& now) { line->show(now); }});
  hard.reset();
  const SweepProgress last = line->last();
  line.reset();
  if (!answer) return print_fault(answer.error(), json);
  print(*plan, *answer, flags, machine_json(last, begin_s));
  return job_done;
}

}  // namespace

void add_sweep(Command& tool, const std::vector<Job>& jobs, const std::stop_token& stop) {
  Command& sweep =
      tool.add("sweep", "many runs of a scenario: a table of them, rates, quantiles, comparisons");
  auto flags = std::make_shared<SweepFlags>();
  sweep
      .positional("scenario", &flags->input,
                  "scenario file; or the folder of a sweep, which is continued and summarised")
      .required()
      .type("FILE");
  sweep
      .option("--vary", &flags->vary,
              "KEY=V,V,... (a grid) or KEY=uniform(a,b), log_uniform(a,b), integer(a,b), normal(mean,sd), "
              "choice(a,b); repeatable")
      .repeatable()
      .type("KEY=VALUES")
      .group("What varies");
  sweep
      .option("--compare", &flags->compare,
              "KEY=A,B: runs each seed with A and with B, and tests the differences; repeatable")
      .repeatable()
      .type("KEY=A,B")
      .group("What varies");
  add_flags(sweep, describe(*flags));
  sweep.does([flags, jobs, stop](const Command& words) { return execute(*flags, words, jobs, stop); });
  sweep.footer("\nExample: outrider sweep scenarios/yard/yard.yaml --runs 1000 --seed 7");
}

}  // namespace outrider::cli
