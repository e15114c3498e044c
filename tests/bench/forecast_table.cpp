// Forecasts and makes the bundled patterns in every format, and compares: processor time and peak memory of each
// work, made in a process of its own, with its forecast. Prints a summary; -o writes the table.
#include "art/gallery/patterns.h"
#include "art/print/format.h"
#include "art/prints.h"
#include "art/sheets.h"
#include "engine/base/output.h"
#include "engine/base/text.h"
#include "engine/language/document.h"
#include "music/arrangement.h"
#include "music/scores.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace {

using namespace sikku;

/// One row of the table.
struct Row {
    std::string pattern, kind;  ///< name, and the folder that it is in
    std::string work;           ///< print, growth, lesson, relief, sheet, score …
    std::string format;
    OptionValues values;
    std::int64_t more_steps = 0;  ///< added to the derivation length
};

/// The report of a child.
struct Outcome {
    Cost cost;
    double forecast_seconds = 0;  ///< of processor time that planning and forecasting took
    double seconds = 0;           ///< of processor time that planning and making took
    double memory = 0;            ///< peak, in bytes
    double bytes = 0;             ///< written
    bool is_forecast = false;
    bool is_made = false;
    char message[300] = {};
};

double processor_seconds() {
    double sum = 0;
    for (const int who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
        rusage usage{};
        getrusage(who, &usage);
        for (const timeval& time : {usage.ru_utime, usage.ru_stime})
            sum += static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
    }
    return sum;
}

Arrangement read_arrangement(const std::string& path) {
    std::string text = read_pattern({path, path});
    return sikku::read_arrangement(path, text, [](const std::string& name) {
        const PatternFile file = find_pattern(name);
        return NamedPattern{file.name, read_pattern(file)};
    });
}

/// The options of the row, with `A:B` generations of the pattern for works that need them.
std::unique_ptr<Work> plan(const Row& row) {
    if (row.kind == "arrangements") {
        const auto path = PatternLibrary::bundled().folder() / row.kind / (row.pattern + ".toml");
        return plan_score(read_arrangement(path.string()), row.format, row.values);
    }
    const PatternFile file = find_pattern(row.pattern);
    Document document = parse(file.name, read_pattern(file));
    const std::int64_t n = document.grammar().steps() + row.more_steps;
    OptionValues values = row.values;
    for (OptionValue& value : values) {
        if (value.name == "generations") value.text = fmt::format("{}:{}", std::max<std::int64_t>(0, n - 6), n);
    }
    if (row.more_steps != 0 && row.work != "growth") {
        document = document.with({Setting{"bench", "derivation length", std::to_string(n)}});
    }
    if (row.work == "score") return scores().plan(document, row.format, values);
    if (row.work != "sheet") return prints().plan(document, row.format, values);
    return plan_sheet({{document, {}}, {document, {{"rotate", "90"}}}, {document, {{"mirror", "true"}}}}, row.format,
                      values);
}

void make(const Row& row, const std::filesystem::path& folder, int threads, Outcome& outcome) {
    try {
        const double start = processor_seconds();
        const auto work = plan(row);
        const double planned = processor_seconds();
        outcome.cost = work->forecast();
        outcome.is_forecast = true;
        const double forecast = processor_seconds();
        outcome.forecast_seconds = forecast - start;
        work->make(file_system(), folder / ("work." + row.format), {}, threads);
        outcome.is_made = true;
        outcome.seconds = processor_seconds() - forecast + planned - start;
    } catch (const std::exception& error) {
        std::string text = error.what();
        std::replace(text.begin(), text.end(), '\n', ' ');
        std::snprintf(outcome.message, sizeof outcome.message, "%s", text.c_str());
        outcome.seconds = processor_seconds();
    }
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        outcome.bytes += static_cast<double>(entry.file_size());
}

/// Makes the work in a child, whose memory is its own. @param limit  seconds of processor time
Outcome run(const Row& row, int threads, rlim_t limit) {
    const auto folder = std::filesystem::temp_directory_path() / fmt::format("sikku-forecasts-{}", getpid());
    std::filesystem::create_directories(folder);
    int pipes[2];
    if (pipe(pipes) != 0) std::abort();
    const pid_t child = fork();
    if (child == 0) {
        close(pipes[0]);
        const rlimit seconds{limit, limit};
        setrlimit(RLIMIT_CPU, &seconds);
        Outcome outcome;
        // The forecast survives an end by the limit of time.
        static Outcome* current = &outcome;
        static int out = pipes[1];
        current = &outcome;
        out = pipes[1];
        std::signal(SIGXCPU, [](int) {
            current->seconds = -1;
            if (write(out, current, sizeof *current) < 0) _exit(3);
            _exit(2);
        });
        const rlimit soft{limit, limit + 2};
        setrlimit(RLIMIT_CPU, &soft);
        make(row, folder, threads, outcome);
        if (write(pipes[1], &outcome, sizeof outcome) < 0) _exit(3);
        _exit(0);
    }
    close(pipes[1]);
    Outcome outcome;
    std::strcpy(outcome.message, "ended without a report");
    Outcome read_outcome;
    const bool is_read = read(pipes[0], &read_outcome, sizeof read_outcome) == sizeof read_outcome;
    close(pipes[0]);
    rusage usage{};
    int status = 0;
    wait4(child, &status, 0, &usage);
    if (is_read) outcome = read_outcome;
    if (outcome.seconds < 0) {
        outcome.seconds = static_cast<double>(limit);
        std::strcpy(outcome.message, "stopped at the limit of time");
    }
    outcome.memory = static_cast<double>(usage.ru_maxrss) * 1024;
    std::filesystem::remove_all(folder);
    return outcome;
}

std::vector<Row> rows_of(const LibraryPattern& pattern, const std::vector<std::string>& sizes, std::int64_t more) {
    std::vector<Row> rows;
    const auto add = [&](const char* work, std::string_view format, const OptionValues& values,
                         std::int64_t longer = 0) {
        rows.push_back({pattern.name, pattern.kind, work, std::string(format), values, more + longer});
    };
    for (const std::string& size : sizes) {
        if (pattern.kind == "arrangements") break;
        const OptionValue page{"size", size};
        for (const FormatInfo& row : print_formats()) {
            if (row.kind == FormatKind::animation) continue;
            add("print", row.extension, {page});
        }
        for (const char* format : {"stl", "glb"}) add("relief", format, {page, {"relief", ""}});
        add("growth", "gif", {page, {"generations", ""}});
        add("division", "gif", {page, {"divide", ""}});
        for (const char* format : {"gif", "pdf", "png"}) add("lesson", format, {page, {"lesson", ""}});
        for (const char* format : {"pdf", "png"}) add("generations", format, {page, {"generations", ""}});
        for (const char* format : {"pdf", "png", "gcode"}) add("sheet", format, {page});
        add("plot", "svg", {page, {"plotter", "true"}, {"hatch", "0.5mm"}});
    }
    for (const std::int64_t longer : {0, 1}) {
        for (const FormatName& row : scores().formats()) add("score", row.extension, {}, longer);
    }
    return rows;
}

/// The bundled patterns and arrangements.
std::vector<LibraryPattern> patterns() {
    std::vector<LibraryPattern> result = PatternLibrary::bundled().patterns();
    const auto folder = PatternLibrary::bundled().folder() / "arrangements";
    std::vector<std::filesystem::path> pieces;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        if (entry.path().extension() == ".toml") pieces.push_back(entry.path());
    }
    std::sort(pieces.begin(), pieces.end());
    for (const auto& piece : pieces) result.push_back({piece.stem().string(), "arrangements", piece});
    return result;
}

struct Share {
    int count = 0, within_2 = 0, within_3 = 0, within_10 = 0;
    double low = 1, high = 1;  ///< smallest and largest ratio of forecast to fact
    void add(double ratio) {
        ++count;
        const double off = std::max(ratio, 1 / ratio);
        within_2 += off <= 2;
        within_3 += off <= 3;
        within_10 += off <= 10;
        low = std::min(low, ratio);
        high = std::max(high, ratio);
    }
    std::string text() const {
        const auto percent = [&](int n) { return count > 0 ? 100.0 * n / count : 100.0; };
        return fmt::format("{:5}  2: {:5.1f} %  3: {:5.1f} %  10: {:5.1f} %  {:.3g} to {:.3g}", count,
                           percent(within_2), percent(within_3), percent(within_10), low, high);
    }
};

struct Options {
    std::size_t every = 1, first = 0;
    std::int64_t more_steps = 0;
    int threads = 1;
    rlim_t limit = 300;
    std::string table;
    std::vector<std::string> only;  ///< `pattern/work/format` or parts of it, with `*`
    std::vector<std::string> sizes = {"A5", "A3"};
};

bool is_wanted(const Row& row, const std::vector<std::string>& only) {
    const std::string name = fmt::format("{}/{}/{}/{}", row.kind, row.pattern, row.work, row.format);
    return only.empty() ||
           std::any_of(only.begin(), only.end(), [&](const std::string& part) { return fits_wildcards(part, name); });
}

int run_table(const Options& options) {
    constexpr double least_seconds = 0.2, refusal_seconds = 1;
    std::FILE* table = options.table.empty() ? nullptr : std::fopen(options.table.c_str(), "w");
    if (table) {
        fmt::print(table,
                   "kind\tpattern\twork\tformat\tsettings\tforecast s\ts\tforecast bytes\tmemory\tforecast "
                   "size\tsize\tforecasting s\tmessage\n");
    }
    std::map<std::string, std::pair<Share, Share>> shares;  // time and memory by work and format
    Share time, memory;
    int refused = 0, late = 0, made = 0;
    std::size_t number = 0;
    for (const LibraryPattern& pattern : patterns()) {
        for (const Row& row : rows_of(pattern, options.sizes, options.more_steps)) {
            if (!is_wanted(row, options.only) || number++ % options.every != options.first) continue;
            const Outcome outcome = run(row, options.threads, options.limit);
            std::string settings;
            for (const OptionValue& value : row.values) settings += fmt::format("{}={} ", value.name, value.text);
            if (row.more_steps != 0) settings += fmt::format("n+{}", row.more_steps);
            if (table) {
                fmt::print(table, "{}\t{}\t{}\t{}\t{}\t{:.4g}\t{:.4g}\t{:.4g}\t{:.4g}\t{:.4g}\t{:.4g}\t{:.3g}\t{}\n",
                           row.kind, row.pattern, row.work, row.format, settings, outcome.cost.seconds,
                           outcome.seconds, outcome.cost.memory, outcome.memory, outcome.cost.bytes, outcome.bytes,
                           outcome.forecast_seconds, outcome.message);
                std::fflush(table);
            }
            const bool is_stopped = std::strncmp(outcome.message, "stopped", 7) == 0;
            if (!outcome.is_made && !is_stopped) {
                ++refused;
                if (outcome.seconds > refusal_seconds) {
                    ++late;
                    fmt::print("refused after {:.2g} s: {} {} {} {}: {}\n", outcome.seconds, row.pattern, row.work,
                               row.format, settings, outcome.message);
                }
                continue;
            }
            ++made;
            auto& [own_time, own_memory] = shares[row.work + " " + row.format];
            const double ratio = outcome.cost.memory / outcome.memory;
            memory.add(ratio);
            own_memory.add(ratio);
            if (outcome.seconds < least_seconds && outcome.cost.seconds < least_seconds) continue;
            time.add(outcome.cost.seconds / outcome.seconds);
            own_time.add(outcome.cost.seconds / outcome.seconds);
            if (is_stopped) {
                fmt::print("not finished after {} s: {} {} {} {}: forecast {:.2g} s\n", options.limit, row.pattern,
                           row.work, row.format, settings, outcome.cost.seconds);
            }
        }
    }
    if (table) std::fclose(table);
    for (const auto& [name, both] : shares) {
        fmt::print("{:<22} time   {}\n", name, both.first.text());
        fmt::print("{:<22} memory {}\n", "", both.second.text());
    }
    fmt::print("{} works made, {} refused, {} of them after more than {} s\n", made, refused, late, refusal_seconds);
    fmt::print("{:<22} time   {}\n", "all above 0.2 s", time.text());
    fmt::print("{:<22} memory {}\n", "all", memory.text());
    const bool holds = time.within_3 >= 0.95 * time.count && time.within_10 == time.count &&
                       memory.within_2 == memory.count && late == 0;
    return holds ? 0 : 1;
}

Options options_of(int count, char** words) {
    Options options;
    for (int i = 1; i < count; ++i) {
        const std::string word = words[i];
        const auto next = [&] {
            if (i + 1 == count) throw std::runtime_error(word + " needs a value");
            return std::string(words[++i]);
        };
        if (word == "--every") {
            options.every = std::stoul(next());
        } else if (word == "--first") {
            options.first = std::stoul(next());
        } else if (word == "--more-steps") {
            options.more_steps = std::stol(next());
        } else if (word == "--threads") {
            options.threads = std::stoi(next());
        } else if (word == "--limit") {
            options.limit = std::stoul(next());
        } else if (word == "--size") {
            options.sizes = {next()};
        } else if (word == "-o") {
            options.table = next();
        } else if (word.starts_with("-")) {
            throw std::runtime_error(
                "usage: sikku_forecast_table [--every N] [--first I] [--more-steps N] [--size SIZE] [--threads N] "
                "[--limit SECONDS] [-o TABLE] [KIND/PATTERN/WORK/FORMAT with wildcards]...");
        } else {
            options.only.push_back(word);
        }
    }
    return options;
}

}  // namespace

int main(int count, char** words) {
    try {
        return run_table(options_of(count, words));
    } catch (const std::exception& error) {
        fmt::print(stderr, "{}\n", error.what());
        return 2;
    }
}
