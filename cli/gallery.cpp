// cli/gallery.cpp: `sikku gallery`: many prints and scores, in parallel, resumed at any time.
#include "art/gallery/gallery.h"
#include "art/gallery/batch.h"
#include "art/gallery/folder.h"
#include "art/prints.h"
#include "cli/arrangement_argument.h"
#include "cli/command.h"
#include "cli/mistakes.h"
#include "cli/options.h"
#include "cli/process.h"
#include "engine/base/memory.h"
#include "engine/base/text.h"
#include "music/scores.h"

#include <fmt/format.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <mutex>
#include <utility>

namespace sikku {
namespace {

struct Options {
    GalleryRequest request;
    std::map<std::string, std::string> texts;  ///< values of the keys of gallery files, as options
    std::map<std::string, bool> flags;
    std::string output = "gallery";
    bool names_folder = false;  ///< true if -o was given
    bool list = false;
    bool json = false;
    bool dry_run = false;
    std::vector<std::string> only;
    bool force = false;
    bool keep_going = false;
    std::string memory;
    int threads = 0;
    std::string shard;
    std::size_t slurm = 0;
};

/// Values that name files beside the gallery file, as seen from the folder of an arrangement.
OptionValues moved(OptionValues values, const std::filesystem::path& from, const std::filesystem::path& to) {
    if (from == to) return values;
    for (OptionValue& value : values) {
        const OptionInfo* row = find_option(scores().options(), value.name);
        if (!row || !row->names_file || !row->names_file(value.text)) continue;
        std::error_code error;
        const auto path = std::filesystem::proximate(from / value.text, to.empty() ? "." : to, error);
        if (!error) value.text = path.string();
    }
    return values;
}

GalleryPiece read_piece(const std::filesystem::path& file, const std::string& name) {
    auto [arrangement, beside] = read_arrangement_file(file, name);
    GalleryPiece piece{arrangement.title, arrangement.source, arrangement.text, {}, {}};
    for (const Track& track : arrangement.tracks) piece.documents.push_back(track.document);
    const auto shared = std::make_shared<const Arrangement>(std::move(arrangement));
    piece.plan = [shared, beside = std::move(beside)](std::string_view format, const OptionValues& values,
                                                      const std::filesystem::path& folder) {
        return plan_score(*shared, format, moved(values, folder, beside), beside);
    };
    return piece;
}

const GalleryKeys& gallery_keys() {
    static const GalleryKeys keys({&prints(), &scores()}, {&scores(), read_piece});
    return keys;
}

/// Reads `--memory`; the default is half of the available memory.
double read_memory(const std::string& text) {
    if (text.empty()) return static_cast<double>(available_memory()) / 2;
    if (const auto bytes = parse_bytes(text)) return *bytes;
    throw UsageError(fmt::format("--memory {}: expected a size such as 1G or 512M", printable(text, 80)));
}

void list_jobs(const std::vector<GalleryJob>& jobs, const std::vector<std::size_t>& chosen, bool json) {
    std::size_t width = 0;
    for (const std::size_t i : chosen) width = std::max(width, jobs[i].file().size());
    for (const std::size_t i : chosen) {
        const GalleryJob& job = jobs[i];
        if (json) {
            fmt::print("{}\n", plain_json(job.text()));
            continue;
        }
        std::string settings = job.pattern->shown;
        for (const auto& [key, value] : job.keys) settings += fmt::format("  {}={}", key, value);
        for (const auto& [key, value] : job.overrides) settings += fmt::format("  {}={}", key, value);
        fmt::print("{:<{}}  {}\n", printable(job.file(), 2000), std::min<std::size_t>(width, 60),
                   printable(settings, std::string::npos));
    }
}

/// Prints the first line of a problem. @returns true, for counting
bool print_problem(const std::string& file, const std::string& problem) {
    fmt::print("{:<40} {}\n", printable(file, 2000), printable(problem.substr(0, problem.find('\n')), 200));
    return true;
}

/// @returns false if a job or a sheet cannot be made
bool print_forecast(Gallery& gallery) {
    Cost sum;
    std::size_t impossible = 0;
    std::vector<const GalleryJob*> possible;
    std::string doubtful;
    fmt::print("{:<40} {:>24} {:>12} {:>10} {:>10}\n", "file", "symbols", "time", "bytes", "memory");
    for (const std::size_t job : gallery.chosen()) {
        const JobForecast& each = gallery.forecast(job);
        const std::string problem = each.problem.empty() ? too_much_memory(each, gallery.memory()) : each.problem;
        if (!problem.empty()) {
            impossible += print_problem(gallery.jobs()[job].file(), problem);
            continue;
        }
        fmt::print("{:<40} {:>24} {:>12} {:>10} {:>10}\n", printable(gallery.jobs()[job].file(), 2000), each.symbols,
                   time_text(each.cost.seconds), bytes_text(each.cost.bytes), bytes_text(each.cost.memory));
        if (each.cost.is_doubtful)
            doubtful += (doubtful.empty() ? "" : ", ") + printable(gallery.jobs()[job].file(), 200);
        possible.push_back(&gallery.jobs()[job]);
        sum.seconds += each.own_seconds();
        sum.shared_seconds = std::max(sum.shared_seconds, each.cost.shared_seconds);
        sum.bytes += each.cost.bytes;
        sum.memory = std::max(sum.memory, each.cost.memory);
    }
    fmt::print("{:<40} {:>24} {:>12} {:>10} {:>10}\n", counted(gallery.chosen().size() - impossible, "job"), "",
               time_text(sum.seconds + sum.shared_seconds), bytes_text(sum.bytes), bytes_text(sum.memory));
    if (!doubtful.empty()) {
        fmt::print("may be refused, because the growth of their words so far leads beyond the budget: {}\n",
                   printable(doubtful, 2000));
    }
    if (impossible > 0) fmt::print("{} cannot be made\n", counted(impossible, "job"));
    for (const auto& [file, forecast] : gallery.sheet_forecasts(possible)) {
        if (!forecast.problem.empty()) {
            impossible += print_problem(file, forecast.problem);
        } else if (forecast.cost.memory > 0) {
            fmt::print("{:<40} {:>24} {:>12} {:>10} {:>10}\n", printable(file, 2000), "", "", "",
                       bytes_text(forecast.cost.memory));
        }
    }
    return impossible == 0;
}

/// The words that this program was started with, without `--slurm`.
std::vector<std::string> own_arguments() {
    std::ifstream stream("/proc/self/cmdline", std::ios::binary);
    std::vector<std::string> words;
    for (std::string word; std::getline(stream, word, '\0');) {
        if (word == "--slurm") {
            std::getline(stream, word, '\0');
        } else if (!word.starts_with("--slurm=")) {
            words.push_back(word);
        }
    }
    std::error_code error;
    const auto program = std::filesystem::read_symlink("/proc/self/exe", error);
    if (!error && !words.empty()) words[0] = program.string();
    return words;
}

/// Writes the Slurm script with the same safeguards as files inside the gallery folder.
/// @param replaces  replace a file or link that is not a gallery script
void write_script(const GalleryFolder& folder, const std::string& name, const std::string& text, bool replaces) {
    const GalleryPlace place = folder.place(name);
    const bool is_ours = folder.read(name, 400).find("\n#SBATCH --job-name=sikku-gallery\n") != std::string::npos;
    if (const auto there = place.status(); there && !S_ISDIR(there->st_mode)) {
        if (!replaces && !is_ours) {
            throw std::runtime_error(fmt::format(
                "'{}' already exists and is not a gallery script; --force replaces it", folder.shown(name)));
        }
        if (!S_ISREG(there->st_mode)) place.remove();
    }
    folder.write(name, text);
}

/// Writes the script beside the folder of the gallery, which contains only the gallery, and submits it to Slurm.
void submit(const Options& options, std::size_t jobs) {
    std::filesystem::path folder = std::filesystem::absolute(options.output).lexically_normal();
    if (folder.filename().empty()) folder = folder.parent_path();
    const std::string script = folder.string() + ".sbatch";
    const std::size_t tasks = std::min(options.slurm, std::max<std::size_t>(jobs, 1));
    write_script(GalleryFolder(folder.parent_path()), folder.filename().string() + ".sbatch",
                 slurm_script(own_arguments(), std::filesystem::current_path().string(), tasks, script),
                 options.force);
    std::string common = "sbatch --parsable --requeue";
    if (options.threads > 0) common += fmt::format(" --cpus-per-task={}", options.threads);
    if (!options.memory.empty())
        common += fmt::format(" --mem={:.0f}M", std::ceil(read_memory(options.memory) / 0x1p20));
    const std::string array = fmt::format("{} --array=0-{} --output={} {}", common, tasks - 1,
                                          shell_word(folder.string() + ".%A_%a.log"), shell_word(script));
    const std::string last = fmt::format("{} --kill-on-invalid-dep=yes --output={} --dependency=afterok:", common,
                                         shell_word(folder.string() + ".%j.log"));
    if (!is_in_path("sbatch")) {
        tell("sikku: sbatch is not available here; to submit {} where it is:\n  id=$({})\n  {}$id {}\n",
             printable(script, 2000), array, last, shell_word(script));
        return;
    }
    // Another cluster's name may follow after a semicolon.
    const auto number = [](const std::string& text) { return text.substr(0, text.find(';')); };
    const std::string id = number(output_of(array));
    const std::string end = number(output_of(last + id + " " + shell_word(script)));
    fmt::print("submitted job {} with {}, followed by job {}; their script is {}\n", id, counted(tasks, "task"), end,
               printable(script, 2000));
}

/// Reports progress on standard error; on a terminal, as a bar with jobs per second and the time left.
class Reporter : public GalleryListener {
public:
    explicit Reporter(bool quiet)
        : quiet_(quiet), shown_(!quiet && isatty(STDERR_FILENO) == 1), started_(seconds_now()), last_(started_) {}

    void begin(std::size_t jobs, double cost) override {
        jobs_ = jobs;
        cost_ = cost;
        started_ = last_ = seconds_now();
    }
    void end() override {
        if (std::exchange(visible_, false)) tell("\r\033[K");
    }
    void sheet(const std::string& name) override {
        if (!shown_) return;
        visible_ = true;
        tell("\r{} …\033[K", printable(name));
    }
    void wait_for_jobs(std::size_t jobs) override {
        tell_unless(quiet_, "sikku: another run is making {}; waiting for it\n", counted(jobs, "job"));
    }
    void wait_for_record(const std::string& record) override {
        tell_unless(quiet_, "sikku: another run is using '{}'; waiting for it\n", printable(record, 2000));
    }
    void finish(double cost) override {
        const std::lock_guard guard(mutex_);
        ++done_;
        done_cost_ += cost;
        show();
    }
    void watch() override {
        if (!shown_) return;
        const std::unique_lock guard(mutex_, std::try_to_lock);
        if (guard) show();
    }

private:
    void show() {
        if (!shown_) return;
        const double time = seconds_now();
        if (time - started_ < 0.5 || time - last_ < 0.1) return;
        last_ = time;
        visible_ = true;
        std::string line = fmt::format("{} of {}", done_, jobs_);
        const double share = cost_ > 0 ? std::min(1.0, done_cost_ / cost_) : 1.0;
        if (done_ > 0) {
            line += fmt::format(", {:.1f} a second, {} left", static_cast<double>(done_) / (time - started_),
                                time_text((time - started_) * (1 - share) / std::max(share, 1e-9)));
        }
        winsize size{};
        const std::size_t columns =
            ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
        constexpr std::size_t most = 30;
        const std::size_t bar = std::min(most, columns - std::min(columns, line.size() + 4));
        if (bar >= 5) {
            const auto filled = static_cast<std::size_t>(share * static_cast<double>(bar));
            line = fmt::format("[{}{}] {}", std::string(filled, '#'), std::string(bar - filled, ' '), line);
        }
        tell("\r{}\033[K", line.substr(0, columns - 1));
    }

    std::size_t jobs_ = 0;
    double cost_ = 0;
    bool quiet_;
    bool shown_;
    bool visible_ = false;
    std::size_t done_ = 0;
    double done_cost_ = 0;
    double started_;
    double last_;
    std::mutex mutex_;
};

/// Prints warnings, at most 20, and one line about the run.
void print_result(const Gallery& gallery, const GalleryResult& result, const Options& options, const Shard& shard,
                  double seconds) {
    std::size_t told = 0;
    for (const std::size_t job : result.made) {
        const FinishedJob& made = result.finished.at(job);
        for (const std::string& text : made.warnings) {
            if (++told <= 20) tell("{}: {}\n", printable(made.file, 2000), printable_lines(text, 2000));
        }
    }
    if (told > 20) tell("sikku: and {} more warnings; see {}\n", told - 20, printable(result.record, 2000));
    const std::size_t made = result.made.size();
    const std::size_t chosen = gallery.chosen().size();
    const std::string all = counted(gallery.jobs().size(), "job");
    const std::string jobs = options.only.empty() ? counted(chosen, "job") : fmt::format("{} of {}", chosen, all);
    const std::size_t skipped = result.finished.size() - made;
    tell("{}{} in {}: {} made", shard.count > 1 ? fmt::format("part {} of {}: ", shard.index, shard.count) : "", jobs,
         time_text(seconds), made);
    if (made > 0 && seconds > 0) tell(" ({:.1f} a second)", static_cast<double>(made) / seconds);
    if (skipped > 0) tell(", {} up to date", skipped);
    if (!result.failures.empty()) tell(", {} failed", result.failures.size());
    if (result.left > 0) tell(", {} not started", result.left);
    tell("\n");
}

/// Each job allocates about as much as the one before. The C library would return it to the system after each job,
/// and new pages cost as much time as a small picture.
void keep_freed_memory() {
#ifdef __GLIBC__
    constexpr int largest = 4 << 20, kept = 8 << 20;  // bytes of a block; of each thread
    ::mallopt(M_MMAP_THRESHOLD, largest);
    ::mallopt(M_TRIM_THRESHOLD, kept);
#endif
}

void run(Options& options, bool quiet) {
    for (const auto& [key, text] : options.texts) {
        if (!text.empty()) options.request.keys[key] = text;
    }
    for (const auto& [key, is_set] : options.flags) {
        if (is_set) options.request.keys[key] = "true";
    }
    options.request.gallery_file = PatternLibrary::bundled().gallery_file(options.request.gallery_file);
    const Shard shard =
        options.slurm > 0 ? Shard{} : read_shard(options.shard, [](const char* name) { return std::getenv(name); });
    Gallery gallery(options.request,
                    {.folder = options.output,
                     .only = options.only,
                     .force = options.force,
                     .keep_going = options.keep_going,
                     .memory = read_memory(options.memory),
                     .threads = options.threads,
                     .shard = shard,
                     .exact = options.dry_run},
                    gallery_keys(), stop_monitor());
    if (options.slurm > 0) return submit(options, gallery.jobs().size());
    if (options.list) return list_jobs(gallery.jobs(), gallery.chosen(), options.json);
    if (options.dry_run) {
        if (!print_forecast(gallery)) throw CLI::RuntimeError(1);
        return;
    }
    const double started = seconds_now();
    if (!options.names_folder && std::filesystem::is_symlink(options.output)) {
        throw UsageError(fmt::format("'{}' is a symbolic link; -o names the folder to write to", options.output));
    }
    Reporter reporter(quiet);
    keep_freed_memory();
    const GalleryResult result = gallery.make(reporter);
    if (!quiet) print_result(gallery, result, options, shard, seconds_now() - started);
    if (interrupted()) {
        throw Interrupted(fmt::format("interrupted; {} of {} jobs are finished; the same command resumes",
                                      result.finished.size(), gallery.chosen().size()));
    }
    for (const Failure& failure : result.failures) {
        const GalleryJob& job = gallery.jobs()[failure.job];
        std::string message = failure.message;
        while (message.ends_with('\n')) message.pop_back();
        tell("sikku: {}{} failed: {}\n", job.place.empty() ? "" : job.place + ": ", printable(job.file(), 2000),
             printable_lines(with_force(message), 2000));
    }
    for (const std::string& warning : result.warnings) tell("sikku: warning: {}\n", printable(warning, 2000));
    for (const std::string& trouble : result.troubles)
        tell("sikku: {}\n", printable_lines(with_force(trouble), 2000));
    if (!result.failures.empty() || !result.troubles.empty()) throw CLI::RuntimeError(1);
}

/// Help of a flag; for flags that are on by default, the table describes what they do while on.
std::string flag_help(const GalleryKey& key) {
    if (!key.name.starts_with("no-")) return key.help;
    return "do not " + key.help.substr(0, key.help.rfind(" (default)"));
}

/// The placeholder of a key's value, from the interpreter's table.
std::string value_name(const GalleryKey& key) {
    if (!key.use) return "VALUE";
    for (const OptionInfo* option : key.use->options()) {
        if (option->name != key.name || option->value.empty()) continue;
        // Brackets mark an optional value, which galleries require.
        const std::string_view value = option->value;
        return std::string(value.starts_with('[') ? value.substr(1, value.size() - 2) : value);
    }
    return "VALUE";
}

}  // namespace

void add_gallery(CLI::App& app, bool& quiet) {
    auto* command =
        app.add_subcommand("gallery", "Make many prints and scores in parallel; resumes where it stopped");
    auto options = std::make_shared<Options>();
    command->add_option(
        "PATTERNS", options->request.patterns,
        "patterns by name, kind, glob, folder or file, and arrangements (all bundled patterns that draw)");
    const OptionGroup group{*command};
    auto* output =
        group.add("-o,--output", options->output, "FOLDER", "folder of the gallery")->capture_default_str();
    group.add("--file", options->request.gallery_file, "FILE",
              "gallery file (TOML) that lists what to make, or the name of a bundled one such as figure-2.5");
    group.add("--manifest", options->request.manifest, "FILE", "file of jobs, one line of JSON each");
    group.add("--poster", options->request.poster, "SIZE",
              "make a poster of all prints, with captions: poster.svg, poster.pdf, poster.png");
    group.add("--contact", options->request.contact, "SIZE", "make a contact sheet, with names: contact.svg, …");
    auto* list = group.flag("--list", options->list, "list the jobs and make nothing");
    group.flag("--json", options->json, "print the list as a manifest (JSON lines)")->needs(list);
    group.flag("--dry-run", options->dry_run, "forecast symbols, time, bytes and memory of each job");
    group.add("--only", options->only, "JOB", "make only this job, even if it is finished; may be repeated")
        ->allow_extra_args(false);
    group.flag("--force", options->force, "make everything again, and replace files not made by the gallery");
    group.flag("--keep-going", options->keep_going, "continue with other jobs after one failed");
    group.add("--memory", options->memory, "BYTES",
              "maximum memory, such as 1G; jobs wait for it (half of the available memory)");
    group.add("-j,--jobs", options->threads, "N", "jobs at a time; 0: one per core (0)")
        ->check(whole_number(0, 1024));
    group.add("--shard", options->shard, "I/N",
              "make only part I of N, balanced by forecast (set by Slurm, Open MPI or Kubernetes)");
    group.add("--slurm", options->slurm, "N", "write a script for an array of N tasks, and submit it")
        ->check(whole_number(1, 100'000));
    group.add("-f,--format", options->texts["format"], "FORMATS",
              gallery_keys().format_list() + "; several with commas");
    group.add("--name", options->texts["name"], "TEXT", "names of the files: {pattern}-n{n}, with any key in braces");
    group
        .add("--set", options->request.overrides, "KEY=VALUE",
             "value of a key or define of the patterns; a range such as 60:90:5 makes several jobs; may be repeated")
        ->allow_extra_args(false);
    for (const GalleryKey& key : gallery_keys().list()) {
        if (!key.is_option) continue;
        const std::string names = key.name == "n" ? "-n,--generations" : "--" + key.name;
        CLI::Option* option = nullptr;
        if (key.kind == OptionKind::flag) {
            option = command->add_flag(names, options->flags[key.name], with_dashes(flag_help(key)));
        } else {
            option = command->add_option(names, options->texts[key.name], with_dashes(key.help))
                         ->type_name(value_name(key));
        }
        if (key.use) option->group(key.use == &prints() ? "Prints" : "Scores");
    }
    command->footer(
        "An interrupted run resumes when it is started again: finished and unchanged files are kept. Files not made "
        "by the gallery are never touched. Several runs can work in one folder at the same time.\n\n"
        "Examples:\n"
        "  sikku gallery kolams -o prints -f svg,png --size 130x130mm --dpi 100\n"
        "  sikku gallery kolams koch-island -o wall --poster A1\n"
        "  sikku gallery koch-island --generations 0:4 --set 'angle increment=80:100:5'\n"
        "  sikku gallery --file gallery.toml --shard 3/8\n"
        "  seq 8 | parallel sikku gallery --file gallery.toml --shard {}/8");
    command->callback([options, output, &quiet] {
        options->names_folder = output->count() > 0;
        run(*options, quiet);
    });
}

}  // namespace sikku
