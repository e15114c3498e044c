// cli/gallery.cpp: `sikku gallery`: many prints and scores, in parallel, to be gone on with at any time.
#include "art/drawing/draw.h"
#include "art/image/image_file.h"
#include "cli/gallery_batch.h"
#include "cli/gallery_shards.h"
#include "cli/gallery_summary.h"
#include "engine/base/output_file.h"
#include "engine/base/text.h"
#include "engine/base/threads.h"

#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <numeric>
#include <set>

namespace sikku {
namespace {

struct Options {
    GalleryRequest request;
    std::map<std::string, std::string> texts;  ///< of the keys of gallery files, as options
    std::map<std::string, bool> flags;
    std::string output = "gallery";
    bool names_folder = false;  ///< -o was given
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

double now() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// `1G`, `512M`, `2GiB`: bytes. Half of what the machine has to give, if nothing is said.
double read_memory(const std::string& text) {
    if (text.empty()) return static_cast<double>(memory_budget()) * 32;
    std::size_t digits = 0;
    while (digits < text.size() && (std::isdigit(static_cast<unsigned char>(text[digits])) || text[digits] == '.')) {
        ++digits;
    }
    static const std::map<std::string, double> units = {
        {"", 1.0},     {"k", 0x1p10},   {"kib", 0x1p10}, {"m", 0x1p20},   {"mib", 0x1p20},
        {"g", 0x1p30}, {"gib", 0x1p30}, {"t", 0x1p40},   {"tib", 0x1p40}, {"kb", 1e3},
        {"mb", 1e6},   {"gb", 1e9},     {"tb", 1e12}};
    const auto unit = units.find(lower_case(text.substr(digits)));
    double value = 0;
    if (!read_number(text.substr(0, digits), value) || unit == units.end() || value <= 0) {
        throw UsageError(fmt::format("--memory {}: expected a size such as 1G or 512M", printable(text, 80)));
    }
    return value * unit->second;
}

/// Bytes that a job takes in the list of all.
constexpr double job_bytes = 700;

/// Calls `work` with every number below `count`, on several threads.
template <typename Work>
void for_each_number(std::size_t count, int threads, const Work& work) {
    on_threads(threads, [&] {
        oneapi::tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
            if (interrupted()) throw Interrupted();
            work(i);
        });
    });
}

/// By the numbers of the jobs.
using Forecasts = std::vector<std::optional<JobForecast>>;

void forecast_all(const std::vector<GalleryJob>& jobs, const std::vector<std::size_t>& wanted, const Options& options,
                  Forecasts& forecasts) {
    for_each_number(wanted.size(), options.threads, [&](std::size_t i) {
        std::optional<JobForecast>& forecast = forecasts[wanted[i]];
        if (!forecast) forecast = forecast_job(jobs[wanted[i]], options.dry_run);
    });
}

/// Numbers of the jobs of this shard, of those of `--only`. Fills in the forecasts that it takes.
std::vector<std::size_t> select(const std::vector<GalleryJob>& jobs, const Shard& shard, const Options& options,
                                Forecasts& forecasts) {
    std::vector<std::size_t> chosen(jobs.size());
    std::iota(chosen.begin(), chosen.end(), std::size_t{0});
    if (shard.count > 1) {
        std::vector<double> costs;
        forecast_all(jobs, chosen, options, forecasts);
        for (const auto& forecast : forecasts) costs.push_back(forecast->cost());
        const std::vector<std::size_t> shards = balance(costs, shard.count);
        std::erase_if(chosen, [&](std::size_t job) { return shards[job] + 1 != shard.index; });
    }
    if (options.only.empty()) return chosen;
    for (const std::string& name : options.only) {
        const auto is_named = [&](const GalleryJob& job) { return job.name == name || job.file() == name; };
        if (std::any_of(jobs.begin(), jobs.end(), is_named)) continue;
        std::vector<std::string_view> names;
        for (const GalleryJob& job : jobs) names.push_back(job.name);
        const std::string_view near = nearest(name, names);
        throw UsageError(
            fmt::format("--only {}: there is no such job{}", printable(name, 80),
                        near.empty() ? "; --list shows them" : fmt::format("; did you mean '{}'?", near)));
    }
    const std::set<std::string> only(options.only.begin(), options.only.end());
    std::erase_if(
        chosen, [&](std::size_t job) { return !only.contains(jobs[job].name) && !only.contains(jobs[job].file()); });
    return chosen;
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

/// Requested sheets.
std::vector<SheetRequest> sheets_of(const GalleryRequest& request, int threads, double memory) {
    std::vector<SheetRequest> sheets;
    if (!request.contact.empty()) sheets.push_back({"contact", request.contact, false, threads, memory});
    if (!request.poster.empty()) sheets.push_back({"poster", request.poster, true, threads, memory});
    return sheets;
}

/// @param jobs  those that can be made
/// @returns false if a sheet cannot be made
bool tell_sheet_forecast(const std::vector<const GalleryJob*>& jobs, const Options& options, double memory) {
    bool can_be_made = true;
    for (const SheetRequest& sheet : sheets_of(options.request, options.threads, memory)) {
        for (const std::string& file : sheet_files(sheet)) {
            std::string problem;
            JobForecast forecast;
            try {
                forecast.memory = gallery_sheet_memory(jobs, sheet, file);
                problem = too_much_memory(forecast, memory);
            } catch (const std::exception& error) {
                problem = error.what();
            }
            can_be_made = can_be_made && problem.empty();
            if (problem.empty() && forecast.memory == 0) continue;
            if (problem.empty())
                problem = fmt::format("{:>24} {:>12} {:>10} {:>10}", "", "", "", bytes_text(forecast.memory));
            fmt::print("{:<40} {}\n", file, printable(problem.substr(0, problem.find('\n')), 200));
        }
    }
    return can_be_made;
}

/// @param memory  bytes for jobs
/// @returns false if one cannot be made
bool tell_forecast(const std::vector<GalleryJob>& jobs, const std::vector<std::size_t>& chosen,
                   const Options& options, double memory, Forecasts& forecasts) {
    forecast_all(jobs, chosen, options, forecasts);
    JobForecast sum;
    std::size_t impossible = 0;
    std::vector<const GalleryJob*> possible;
    fmt::print("{:<40} {:>24} {:>12} {:>10} {:>10}\n", "file", "symbols", "time", "bytes", "memory");
    for (const std::size_t job : chosen) {
        const JobForecast& each = *forecasts[job];
        const std::string problem = each.problem.empty() ? too_much_memory(each, memory) : each.problem;
        if (!problem.empty()) {
            ++impossible;
            fmt::print("{:<40} {}\n", printable(jobs[job].file(), 2000),
                       printable(problem.substr(0, problem.find('\n')), 200));
            continue;
        }
        fmt::print("{:<40} {:>24} {:>12} {:>10} {:>10}\n", printable(jobs[job].file(), 2000), each.symbols,
                   time_text(each.seconds), bytes_text(each.bytes), bytes_text(each.memory));
        possible.push_back(&jobs[job]);
        sum.seconds += each.seconds;
        sum.bytes += each.bytes;
        sum.memory = std::max(sum.memory, each.memory);
    }
    fmt::print("{:<40} {:>24} {:>12} {:>10} {:>10}\n", counted(chosen.size() - impossible, "job"), "",
               time_text(sum.seconds), bytes_text(sum.bytes), bytes_text(sum.memory));
    if (impossible > 0) fmt::print("{} cannot be made\n", counted(impossible, "job"));
    const bool is_whole = chosen.size() == jobs.size();
    return (!is_whole || tell_sheet_forecast(possible, options, memory)) && impossible == 0;
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

/// Runs a command line of the shell; its standard output without the last line feed.
/// @throws std::runtime_error if it fails
std::string output_of(const std::string& command) {
    std::FILE* pipe = ::popen(command.c_str(), "r");
    if (!pipe) throw std::runtime_error(fmt::format("cannot start: {}", command));
    std::string text;
    std::array<char, 512> block{};
    for (std::size_t got = 0; (got = std::fread(block.data(), 1, block.size(), pipe)) > 0;)
        text.append(block.data(), got);
    if (::pclose(pipe) != 0) throw std::runtime_error(fmt::format("this failed: {}", command));
    while (text.ends_with('\n')) text.pop_back();
    return text;
}

bool is_in_path(const std::string& program) {
    const char* path = std::getenv("PATH");
    std::string folders = path ? path : "";
    for (std::size_t at = 0; at <= folders.size();) {
        const std::size_t colon = std::min(folders.find(':', at), folders.size());
        const std::string file = folders.substr(at, colon - at) + "/" + program;
        if (::access(file.c_str(), X_OK) == 0) return true;
        at = colon + 1;
    }
    return false;
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
    try {
        OutputFile output(place.path());
        output.write(text);
        output.commit();
    } catch (const std::runtime_error& error) {
        throw std::runtime_error(place.readable(error.what()));
    }
}

/// Writes the script beside the folder of the gallery, which holds nothing but the gallery, and hands it to Slurm.
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
                                          quoted(folder.string() + ".%A_%a.log"), quoted(script));
    const std::string last = fmt::format("{} --kill-on-invalid-dep=yes --output={} --dependency=afterok:", common,
                                         quoted(folder.string() + ".%j.log"));
    if (!is_in_path("sbatch")) {
        tell("sikku: there is no sbatch here; {} is to be handed in where there is one:\n  id=$({})\n  {}$id {}\n",
             script, array, last, quoted(script));
        return;
    }
    // Another cluster's name may follow behind a semicolon.
    const auto number = [](const std::string& text) { return text.substr(0, text.find(';')); };
    const std::string id = number(output_of(array));
    const std::string end = number(output_of(last + id + " " + quoted(script)));
    fmt::print("Slurm has job {} with {}, and job {} that comes last; {} is their script\n", id,
               counted(tasks, "task"), end, script);
}

/// The page and the sheets: made anew where what they show has changed.
class Summaries {
public:
    Summaries(const std::vector<GalleryJob>& jobs, const std::map<std::size_t, FinishedJob>& finished,
              const GalleryFolder& folder, GalleryRecord& record, const Options& options, bool quiet)
        : folder_(folder), record_(record), options_(options), shown_(!quiet && isatty(STDERR_FILENO) == 1) {
        for (const auto& [job, result] : finished) {
            jobs_.push_back(&jobs[job]);
            held_.add_piece(result.file);
            held_.add_piece(result.hash);
        }
    }

    /// @param order     gets what is there in the end
    /// @param troubles  why others are not
    void make(const GalleryRequest& request, double memory, std::vector<FinishedJob>& order,
              std::vector<std::string>& troubles) {
        const auto draw = [&](bool posters) {
            for (const SheetRequest& sheet : sheets_of(request, options_.threads, memory)) {
                if (sheet.is_poster != posters) continue;
                for (const std::string& file : sheet_files(sheet)) {
                    make(file, sheet.size, order, troubles, [&](const std::filesystem::path& path) {
                        draw_gallery_sheet(jobs_, sheet, path, [](std::uint64_t) {
                            if (interrupted()) throw Interrupted();
                        });
                    });
                }
            }
        };
        draw(false);
        make("index.html", request.title, order, troubles,
             [&](const std::filesystem::path& path) { write_gallery_index(jobs_, request.title, path); });
        draw(true);
    }

private:
    template <typename Make>
    void make(const std::string& name, const std::string& setting, std::vector<FinishedJob>& order,
              std::vector<std::string>& troubles, const Make& make_it) {
        FinishedJob file;
        file.file = name;
        TextHash hash = held_;
        hash.add_piece(SIKKU_VERSION);
        hash.add_piece(name);
        hash.add_piece(setting);
        file.hash = hash.digits();
        file.job = fmt::format("{{\"summary\":{}}}", json_string(setting));
        if (!options_.force) {
            if (auto known = record_.finished(name, file.hash)) {
                order.push_back(std::move(*known));
                return;
            }
        }
        if (shown_) tell("\r{} …\033[K", name);
        try {
            const bool is_ours =
                name == "index.html" ? is_gallery_page(folder_.read(name, 4096)) : record_.is_ours(name);
            order.push_back(make_gallery_file(record_, folder_, std::move(file), options_.force || is_ours,
                                              [&](const std::filesystem::path& path, auto&) { make_it(path); }));
        } catch (const Stopped&) {
            if (shown_) tell("\r\033[K");
            throw;
        } catch (const std::exception& error) {
            troubles.push_back(fmt::format("{} failed: {}", name, error.what()));
        }
        if (shown_) tell("\r\033[K");
    }

    std::vector<const GalleryJob*> jobs_;  ///< that are there
    TextHash held_;
    const GalleryFolder& folder_;
    GalleryRecord& record_;
    const Options& options_;
    bool shown_;
};

void run(Options& options, bool quiet) {
    for (const auto& [key, text] : options.texts) {
        if (!text.empty()) options.request.keys[key] = text;
    }
    for (const auto& [key, is_set] : options.flags) {
        if (is_set) options.request.keys[key] = "true";
    }
    const double memory = read_memory(options.memory);
    options.request.gallery_file = known_gallery(options.request.gallery_file);
    const std::vector<GalleryJob> jobs = gallery_jobs(options.request);
    if (options.slurm > 0) return submit(options, jobs.size());
    const Shard shard = read_shard(options.shard, [](const char* name) { return std::getenv(name); });
    Forecasts forecasts(jobs.size());
    const std::vector<std::size_t> chosen = select(jobs, shard, options, forecasts);
    if (options.list) return list_jobs(jobs, chosen, options.json);
    const GalleryRequest& request = options.request;
    const bool pictures = !request.poster.empty() || !request.contact.empty() ||
                          std::any_of(chosen.begin(), chosen.end(), [&](std::size_t job) {
                              return !jobs[job].is_score() && jobs[job].format != "svg" && jobs[job].format != "pdf";
                          });
    const double base = base_memory(pictures) + static_cast<double>(jobs.size()) * job_bytes;
    const double for_jobs = std::max(memory - base, memory / 8);
    if (options.dry_run) {
        if (!tell_forecast(jobs, chosen, options, for_jobs, forecasts)) throw CLI::RuntimeError(1);
        return;
    }

    const double started = now();
    if (!options.names_folder && std::filesystem::is_symlink(options.output)) {
        throw UsageError(fmt::format("'{}' is a symbolic link; -o names the folder to write to", options.output));
    }
    const GalleryFolder folder(options.output);
    bool told_waiting = false;
    GalleryRecord record(folder, shard.record_name(), options.force, [&] {
        if (interrupted()) throw Interrupted("interrupted while waiting for another run; nothing was made");
        if (std::exchange(told_waiting, true) || quiet) return;
        tell("sikku: another run is using '{}'; waiting for it\n", folder.shown(shard.record_name()));
    });
    std::vector<std::string> hashes(jobs.size());
    for_each_number(chosen.size(), options.threads,
                    [&](std::size_t i) { hashes[chosen[i]] = jobs[chosen[i]].hash(); });
    std::map<std::size_t, FinishedJob> finished;
    std::vector<std::size_t> pending;
    const bool redo = options.force || !options.only.empty();
    for (const std::size_t job : chosen) {
        auto known = redo ? std::nullopt : record.finished(jobs[job].file(), hashes[job]);
        if (known) {
            finished.emplace(job, std::move(*known));
        } else {
            pending.push_back(job);
        }
    }
    forecast_all(jobs, pending, options, forecasts);
    std::vector<Task> tasks;
    for (const std::size_t job : pending) tasks.push_back({job, *forecasts[job], false});
    const bool makes_pictures = std::any_of(pending.begin(), pending.end(), [&](std::size_t job) {
        const auto format = print_format(jobs[job].file());
        return !jobs[job].is_score() && format && !is_vector(*format);
    });
    if (makes_pictures) prepare_images(thread_count(options.threads));
    Batch batch(jobs, hashes, folder, record,
                {.threads = options.threads,
                 .replaces = options.force,
                 .redoes = redo,
                 .keep_going = options.keep_going,
                 .quiet = quiet});
    if (!tasks.empty()) batch.run(std::move(tasks), for_jobs);
    finished.insert(batch.found.begin(), batch.found.end());
    const std::size_t skipped = finished.size();
    finished.insert(batch.finished.begin(), batch.finished.end());

    std::vector<FinishedJob> order;
    std::set<std::size_t> is_chosen(chosen.begin(), chosen.end());
    for (std::size_t job = 0; job < jobs.size(); ++job) {
        if (const auto found = finished.find(job); found != finished.end()) {
            order.push_back(found->second);
        } else if (shard.count == 1 && !is_chosen.contains(job)) {
            if (auto known = record.present(jobs[job].file())) order.push_back(std::move(*known));
        }
    }
    const std::size_t made = batch.finished.size();
    const double seconds = now() - started;
    std::vector<std::string> troubles;
    const bool is_whole = shard.count == 1 && options.only.empty();
    if (is_whole && !finished.empty() && (batch.failures.empty() || options.keep_going)) {
        try {
            Summaries summaries(jobs, finished, folder, record, options, quiet);
            summaries.make(request, for_jobs, order, troubles);
        } catch (const Stopped&) {
        }
    }
    try {
        record.complete(order, batch.begun, shard.count == 1);
    } catch (const std::exception& error) {
        troubles.push_back(error.what());  // the lines appended so far hold all the same
    }
    if (!quiet) {
        std::size_t told = 0;
        for (const auto& [job, result] : batch.finished) {
            for (const std::string& text : result.told) {
                if (text.find("warning:") == std::string::npos) continue;
                if (++told <= 20) tell("{}: {}\n", printable(result.file, 2000), printable(text, 2000));
            }
        }
        if (told > 20) tell("sikku: and {} more warnings; see {}\n", told - 20, folder.shown(shard.record_name()));
        tell("{}{}{} in {}: {} made", shard.count > 1 ? fmt::format("part {} of {}: ", shard.index, shard.count) : "",
             counted(chosen.size(), "job"), options.only.empty() ? "" : " chosen", time_text(seconds), made);
        if (made > 0 && seconds > 0) tell(" ({:.1f} a second)", static_cast<double>(made) / seconds);
        if (skipped > 0) tell(", {} there already", skipped);
        if (!batch.failures.empty()) tell(", {} failed", batch.failures.size());
        if (batch.left() > 0) tell(", {} not begun", batch.left());
        tell("\n");
    }
    if (interrupted()) {
        throw Interrupted(
            fmt::format("interrupted; {} of {} are there, the same command goes on", finished.size(), chosen.size())
                .c_str());
    }
    for (const Failure& failure : batch.failures) {
        const GalleryJob& job = jobs[failure.job];
        std::string message = failure.message;
        while (message.ends_with('\n')) message.pop_back();
        tell("sikku: {}{} failed: {}\n", job.place.empty() ? "" : job.place + ": ", printable(job.file(), 2000),
             printable(message, 2000));
    }
    for (const std::string& trouble : troubles) tell("sikku: {}\n", printable(trouble, 2000));
    if (!batch.failures.empty() || !troubles.empty()) throw CLI::RuntimeError(1);
}

}  // namespace

void add_gallery(CLI::App& app, bool& quiet) {
    auto* command = app.add_subcommand("gallery", "Many prints and scores, in parallel; goes on where it was");
    auto options = std::make_shared<Options>();
    command->add_option("PATTERNS", options->request.patterns,
                        "Names, globs, folders or files; without any, all patterns that come along and draw");
    auto* output = command->add_option("-o,--output", options->output, "The folder")->capture_default_str();
    command->add_option(
        "--file", options->request.gallery_file,
        "A gallery file, gallery.toml: what is to be made; or the name of one that comes along, such as figure-2.5");
    command->add_option("--manifest", options->request.manifest, "A file of jobs, one a line of JSON");
    command
        ->add_option("--poster", options->request.poster,
                     "All prints on one sheet of this size, with captions: poster.svg, poster.pdf, poster.png")
        ->type_name("SIZE");
    command->add_option("--contact", options->request.contact, "A contact sheet likewise, with names: contact.svg, …")
        ->type_name("SIZE");
    auto* list = command->add_flag("--list", options->list, "Show the jobs, make nothing");
    command->add_flag("--json", options->json, "With --list: as a manifest")->needs(list);
    command->add_flag("--dry-run", options->dry_run, "Forecast symbols, time, bytes and memory of each job");
    command->add_option("--only", options->only, "Make this job anew, and no other")->allow_extra_args(false);
    command->add_flag("--force", options->force, "Make all anew, and replace files of others that are in the way");
    command->add_flag("--keep-going", options->keep_going, "Go on with other jobs after one failed");
    command->add_option("--memory", options->memory, "Most memory, such as 1G; jobs wait rather than exceed it");
    command->add_option("-j,--jobs", options->threads, "Jobs at a time; 0: one for each core")
        ->check(CLI::Range(0, 1024))
        ->capture_default_str();
    command->add_option("--shard", options->shard,
                        "i/N: part i of N, balanced by forecast; without it, as Slurm, Open MPI or Kubernetes say");
    command->add_option("--slurm", options->slurm, "Write a script for an array of N tasks, and submit it")
        ->check(CLI::Range(1, 100'000));
    command->add_option(
        "-f,--format", options->texts["format"],
        "svg, pdf, png, tif, jpg, exr, mid, musicxml, ly, wav, flac, notes.svg, html; several with commas");
    command->add_option("--name", options->texts["name"], "Names of the files: {pattern}-n{n}, any key in braces");
    command->add_option("--set", options->request.overrides, "KEY=VALUE of the pattern; 60:90:5 makes several")
        ->type_name("KEY=VALUE")
        ->allow_extra_args(false);
    for (const GalleryKey& key : gallery_keys()) {
        if (!key.is_option) continue;
        const std::string names = key.name == "n" ? "-n,--generations" : "--" + key.name;
        if (key.is_flag) {
            command->add_flag(names, options->flags[key.name], key.help);
        } else {
            command->add_option(names, options->texts[key.name], key.help)->type_name("VALUE");
        }
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
