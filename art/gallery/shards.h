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

/// From `i/N`, or from what a batch system says: an array of Slurm (whatever its first index), ranks of Open MPI, an
/// indexed job of Kubernetes. `/N` leaves the index to them. Without any, the whole.
/// @throws GalleryError
Shard read_shard(const std::string& text, const Environment& environment);

/// Which of `count` shards takes each job: the dearest first, each to the shard that has least to do. Depends on
/// nothing but the costs.
std::vector<std::size_t> balance(const std::vector<double>& costs, std::size_t count);

/// A script for sbatch that runs `arguments` (a program and what follows), as a task of an array and, once more, for
/// what is left to do when all are done.
std::string slurm_script(const std::vector<std::string>& arguments, const std::string& folder, std::size_t tasks,
                         const std::string& log);

/// As a word of a shell.
std::string quoted(const std::string& word);

}  // namespace sikku
