// The program as a whole, seen from outside: seconds from start to end, and peak memory, against what any program
// that did nothing else would need.
#include <benchmark/benchmark.h>
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

namespace {

struct Outcome {
    double seconds = 0;
    double megabytes = 0;  // peak, of the first program of the pipe
};

/// Runs `command`, its output going through a pipe to `cat >/dev/null` or straight to /dev/null.
Outcome run(const std::vector<std::string>& command, bool piped) {
    std::vector<char*> words;
    for (const std::string& word : command) words.push_back(const_cast<char*>(word.c_str()));
    words.push_back(nullptr);
    int pipes[2] = {-1, -1};
    if (piped && pipe(pipes) != 0) std::abort();
    const auto start = std::chrono::steady_clock::now();
    const pid_t first = fork();
    if (first == 0) {
        const int out = piped ? pipes[1] : open("/dev/null", O_WRONLY);
        dup2(out, STDOUT_FILENO);
        if (piped) close(pipes[0]);
        if (piped) close(pipes[1]);
        execvp(words[0], words.data());
        _exit(127);
    }
    pid_t reader = -1;
    if (piped) {
        reader = fork();
        if (reader == 0) {
            dup2(pipes[0], STDIN_FILENO);
            dup2(open("/dev/null", O_WRONLY), STDOUT_FILENO);
            close(pipes[0]);
            close(pipes[1]);
            execlp("cat", "cat", nullptr);
            _exit(127);
        }
        close(pipes[0]);
        close(pipes[1]);
    }
    rusage usage{};
    int status = 0;
    wait4(first, &status, 0, &usage);
    if (piped) waitpid(reader, nullptr, 0);
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) std::abort();
    return {taken.count(), static_cast<double>(usage.ru_maxrss) / 1024};
}

void measure(benchmark::State& state, const std::vector<std::string>& command, bool piped = false) {
    double megabytes = 0;
    for (auto _ : state) {
        const Outcome outcome = run(command, piped);
        state.SetIterationTime(outcome.seconds);
        megabytes = std::max(megabytes, outcome.megabytes);
    }
    state.counters["peak_MB"] = megabytes;
}

std::string output(const char* name) {
    return (std::filesystem::temp_directory_path() / name).string();
}

void zeros_to_pipe(benchmark::State& state) {
    measure(state, {"head", "-c", "997000000", "/dev/zero"}, true);
}
void derive_to_pipe(benchmark::State& state) {
    measure(state, {SIKKU_PROGRAM, "derive", "koch-island", "-n", "9"}, true);
}
void version(benchmark::State& state) {
    measure(state, {SIKKU_PROGRAM, "--version"});
}
void measure_hilbert_60(benchmark::State& state) {
    measure(state, {SIKKU_PROGRAM, "measure", "hilbert", "-n", "60"});
}
void measure_dragon_100(benchmark::State& state) {
    measure(state, {SIKKU_PROGRAM, "measure", "dragon", "-n", "100"});
}
void svg_of_a_million_segments(benchmark::State& state) {
    const std::string file = output("sikku_bench.svg");
    measure(state, {SIKKU_PROGRAM, "draw", "hilbert", "-n", "10", "-o", file});
    state.counters["file_MB"] = static_cast<double>(std::filesystem::file_size(file)) / 1e6;
    std::filesystem::remove(file);
}
void png_of_a_kolam_at_a0(benchmark::State& state) {
    const std::string file = output("sikku_bench.png");
    measure(state, {SIKKU_PROGRAM, "draw", "snake-kolam", "--size", "A0", "--dpi", "300", "-o", file});
    state.counters["file_MB"] = static_cast<double>(std::filesystem::file_size(file)) / 1e6;
    std::filesystem::remove(file);
}

/// 1,677,722 notes for order 11, four times as many for order 12.
void play_hilbert(benchmark::State& state) {
    const std::string file = output("sikku_bench.mid");
    measure(state, {SIKKU_PROGRAM, "-q", "play", "hilbert", "-n", std::to_string(state.range(0)), "-o", file});
    const double notes = state.range(0) == 11 ? 1'677'722 : 6'710'886;
    state.counters["notes/s"] =
        benchmark::Counter(notes * static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
    state.counters["file_MB"] = static_cast<double>(std::filesystem::file_size(file)) / 1e6;
    std::filesystem::remove(file);
}
/// The same notes, led by harmony and phrases, with velocities along the curve.
void play_hilbert_expressively(benchmark::State& state) {
    const std::string file = output("sikku_bench.mid");
    measure(state, {SIKKU_PROGRAM, "-q", "play", "hilbert", "-n", "12", "--harmony", "triads", "--phrases", "3",
                    "--velocity", "by y 40-100", "-o", file});
    state.counters["notes/s"] =
        benchmark::Counter(6'710'886 * static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
    std::filesystem::remove(file);
}
void bar_of_hilbert_40(benchmark::State& state) {
    const std::string file = output("sikku_bench.mid");
    measure(state, {SIKKU_PROGRAM, "-q", "play", "hilbert", "-n", "40", "--from-bar", "1000000000", "--bars", "1",
                    "-o", file});
    std::filesystem::remove(file);
}

// Zeros and symbols take turns (--benchmark_enable_random_interleaving=true), so that both see the same machine.
BENCHMARK(zeros_to_pipe)->UseManualTime()->Unit(benchmark::kMillisecond)->Iterations(1)->Repetitions(9);
BENCHMARK(derive_to_pipe)->UseManualTime()->Unit(benchmark::kMillisecond)->Iterations(1)->Repetitions(9);
BENCHMARK(version)->UseManualTime()->Unit(benchmark::kMillisecond);
BENCHMARK(measure_hilbert_60)->UseManualTime()->Unit(benchmark::kMillisecond);
BENCHMARK(measure_dragon_100)->UseManualTime()->Unit(benchmark::kMillisecond);
BENCHMARK(svg_of_a_million_segments)->UseManualTime()->Unit(benchmark::kMillisecond);
BENCHMARK(play_hilbert)->Arg(11)->Arg(12)->UseManualTime()->Unit(benchmark::kMillisecond);
BENCHMARK(play_hilbert_expressively)->UseManualTime()->Unit(benchmark::kMillisecond);
BENCHMARK(bar_of_hilbert_40)->UseManualTime()->Unit(benchmark::kMillisecond);
BENCHMARK(png_of_a_kolam_at_a0)->UseManualTime()->Unit(benchmark::kMillisecond);

}  // namespace
