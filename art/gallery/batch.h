// art/gallery/batch.h: makes the jobs of a gallery in parallel within a memory budget.
#pragma once

#include "art/gallery/forecast.h"
#include "art/gallery/jobs.h"
#include "art/gallery/record.h"

#include <condition_variable>
#include <cstddef>
#include <functional>
#include <list>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace sikku {

/// Reason why a job cannot be made within this many bytes; empty if it can.
std::string too_much_memory(const JobForecast& forecast, double memory);

/// Makes a file at a path and adds its messages to `file`.
using FileMaker = std::function<void(const std::filesystem::path& path, FinishedJob& file)>;

/// Makes a file of the gallery and records it. The caller must ensure that no other run makes it at the same time.
/// @param file  with `file`, `hash` and `job` set
/// @param replaces  replace an existing file even if it was not made by this gallery; otherwise it causes a
///                  std::runtime_error. Anything that is neither a file nor a folder, such as a link, is removed
///                  first
/// @throws exceptions of `make`; other errors than Stopped as std::runtime_error
FinishedJob make_gallery_file(GalleryRecord& record, const GalleryFolder& folder, FinishedJob file, bool replaces,
                              const FileMaker& make);

/// A job that is to be made in this run.
struct Task {
    std::size_t job = 0;  ///< its number in the gallery
    JobForecast forecast;
    bool was_busy = false;  ///< another run was making it
};

struct BatchOptions {
    int threads = 0;        ///< 0: one for each core
    bool replaces = false;  ///< also replace files not made by this gallery
    bool redoes = false;    ///< also make jobs that another run finished meanwhile
    bool keep_going = false;
};

/// Makes jobs in parallel within a memory budget. Jobs that another run is making wait until the end, by which time
/// they are usually finished. The most expensive jobs come first, so that the last ones started end soon; jobs that
/// an earlier run began and did not finish come last, cheapest first, so that repeatedly killed runs still make
/// progress.
class Batch {
public:
    Batch(const std::vector<GalleryJob>& jobs, const std::vector<std::string>& hashes, const GalleryFolder& folder,
          GalleryRecord& record, const BatchOptions& options, GalleryListener& listener, const Monitor& monitor)
        : jobs_(jobs),
          hashes_(hashes),
          folder_(folder),
          record_(record),
          options_(options),
          listener_(listener),
          monitor_(monitor) {}

    /// @param memory  bytes for all jobs in progress
    void run(std::vector<Task> tasks, double memory);

    std::map<std::size_t, FinishedJob> finished;  ///< made by this run
    std::map<std::size_t, FinishedJob> found;     ///< finished by other runs meanwhile
    std::vector<Failure> failures;
    std::vector<std::string> begun;  ///< files whose making was interrupted
    std::size_t left() const { return waiting_.size(); }

private:
    struct Turn {
        Task task;
        int threads = 1;
        double memory = 0;
    };
    std::optional<Turn> next();
    void tell_waiting();
    void work();
    void make(const Turn& turn);
    FinishedJob make_job(const Turn& turn);

    const std::vector<GalleryJob>& jobs_;
    const std::vector<std::string>& hashes_;
    const GalleryFolder& folder_;
    GalleryRecord& record_;
    const BatchOptions options_;
    GalleryListener& listener_;
    Monitor monitor_;
    std::mutex mutex_;
    std::condition_variable changed_;
    std::list<Task> waiting_;
    std::size_t under_way_ = 0;
    double free_ = 0;
    double memory_ = 0;
    int workers_ = 1;
    bool stopped_ = false;
    bool told_waiting_ = false;
};

}  // namespace sikku
