#include "art/gallery/shards.h"

#include "art/gallery/values.h"
#include "engine/base/option.h"

#include "engine/base/diagnostic.h"
#include "engine/base/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <numeric>
#include <optional>
#include <queue>

namespace sikku {
namespace {

constexpr std::size_t most_shards = 100'000;

std::optional<std::size_t> whole(std::string_view text) {
    std::size_t value = 0;
    const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || stop != text.data() + text.size()) return std::nullopt;
    return value;
}

std::optional<std::size_t> variable(const Environment& environment, const char* name) {
    const char* text = environment(name);
    if (!text || *text == '\0') return std::nullopt;
    const auto value = whole(text);
    if (!value) throw GalleryError(fmt::format("{}={}: expected a whole number", name, printable(text, 80)));
    return value;
}

}  // namespace

std::string Shard::record_name() const {
    return count == 1 ? "gallery.jsonl" : fmt::format("gallery-{}-of-{}.jsonl", index, count);
}

Shard read_shard(const std::string& text, const Environment& environment) {
    Shard shard;
    std::optional<std::size_t> count;
    if (!text.empty()) {
        const std::size_t slash = text.find('/');
        count = slash == std::string::npos ? std::nullopt : whole(std::string_view(text).substr(slash + 1));
        const auto index =
            slash == 0 ? std::optional<std::size_t>(1) : whole(std::string_view(text).substr(0, slash));
        if (!count || !index || *index < 1 || *index > *count || *count > most_shards) {
            throw SettingError("shard", text, "expected a part such as 3/8, from 1/8 to 8/8, or /8");
        }
        shard = {*index, *count};
        if (slash > 0) return shard;
    }
    std::optional<std::size_t> index;
    std::optional<std::size_t> told;
    const char* source = "SLURM_ARRAY_TASK_ID";
    if (const auto id = variable(environment, "SLURM_ARRAY_TASK_ID")) {
        const std::size_t first = variable(environment, "SLURM_ARRAY_TASK_MIN").value_or(0);
        const std::size_t step = std::max<std::size_t>(1, variable(environment, "SLURM_ARRAY_TASK_STEP").value_or(1));
        if (*id < first) throw GalleryError("SLURM_ARRAY_TASK_ID is below SLURM_ARRAY_TASK_MIN");
        index = (*id - first) / step;
        told = variable(environment, "SLURM_ARRAY_TASK_COUNT");
    } else if (const auto rank = variable(environment, "OMPI_COMM_WORLD_RANK")) {
        source = "OMPI_COMM_WORLD_RANK";
        index = rank;
        told = variable(environment, "OMPI_COMM_WORLD_SIZE");
    } else if (const auto completion = variable(environment, "JOB_COMPLETION_INDEX")) {
        source = "JOB_COMPLETION_INDEX";
        index = completion;
        told = variable(environment, "JOB_COMPLETIONS");
    }
    if (!index) {
        if (count) {
            throw SettingError("shard", text, "no batch system states which part this is");
        }
        return shard;
    }
    if (!count) count = told;
    if (!count)
        throw GalleryError(
            fmt::format("{} is set, but not the number of parts; set it by the option 'shard', /N", source));
    if (*index >= *count || *count > most_shards) {
        throw GalleryError(fmt::format("{} says part {} of {}", source, *index + 1, *count));
    }
    return {*index + 1, *count};
}

std::vector<std::size_t> balance(const std::vector<double>& costs, std::size_t count) {
    std::vector<std::size_t> order(costs.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return costs[a] > costs[b]; });
    using Load = std::pair<double, std::size_t>;
    std::priority_queue<Load, std::vector<Load>, std::greater<>> loads;
    for (std::size_t shard = 0; shard < count; ++shard) loads.emplace(0.0, shard);
    std::vector<std::size_t> shards(costs.size(), 0);
    for (const std::size_t job : order) {
        auto [load, shard] = loads.top();
        loads.pop();
        shards[job] = shard;
        loads.emplace(load + costs[job], shard);
    }
    return shards;
}

std::string slurm_script(const std::vector<std::string>& arguments, const std::string& folder, std::size_t tasks,
                         const std::string& log) {
    std::string command;
    for (const std::string& argument : arguments) command += (command.empty() ? "" : " ") + shell_word(argument);
    // A line feed would end the comment.
    std::string script = shell_word(log);
    std::replace(script.begin(), script.end(), '\n', ' ');
    return fmt::format(
        "#!/bin/bash\n"
        "# A gallery in {0} parts, and then what the whole of it takes:\n"
        "#   id=$(sbatch --parsable --array=0-{1} {2})\n"
        "#   sbatch --dependency=afterok:$id {2}\n"
        "#SBATCH --job-name=sikku-gallery\n"
        "#SBATCH --requeue\n"
        "#SBATCH --open-mode=append\n"
        "cd {3} && exec {4}\n",
        tasks, tasks - 1, script, shell_word(folder), command);
}

}  // namespace sikku
