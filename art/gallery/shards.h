// art/gallery/shards.h: divides a gallery into parts for several machines.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace sikku {

/// Part `index` of `count`, counted from 1.
struct Shard {
    std::size_t index = 1;
    std::size_t count = 1;
    /// The record of its jobs: `gallery.jsonl`, or `gallery-3-of-8.jsonl`.
    std::string record_name() const;
};

/// The value of a variable of the environment, or null.
using Environment = std::function<const char*(const char* name)>;

/// Reads `i/N`, or the variables of a batch system: an array of Slurm (whatever its first index), ranks of Open MPI,
/// an indexed job of Kubernetes. `/N` takes only the index from them. Without any, the shard is the whole gallery.
/// @throws GalleryError
Shard read_shard(const std::string& text, const Environment& environment);

/// Assigns each job to one of `count` shards: the most expensive first, each to the shard with the least work so far.
/// The result depends only on the costs.
std::vector<std::size_t> balance(const std::vector<double>& costs, std::size_t count);

/// A script for sbatch that runs `arguments` (a program and its arguments) as each task of an array and, once more,
/// for the remaining work when all tasks have ended.
std::string slurm_script(const std::vector<std::string>& arguments, const std::string& folder, std::size_t tasks,
                         const std::string& log);

}  // namespace sikku
