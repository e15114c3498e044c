// art/gallery/batch.h: makes the jobs of a gallery in parallel within a memory budget.
#pragma once

#include "art/gallery/forecast.h"
#include "art/gallery/jobs.h"
#include "art/gallery/publisher.h"
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
    MadeFile make_job(const Turn& turn);
    void take(const Turn& turn, FinishedJob file, std::string problem);
    void fail(std::size_t job, std::string problem);

    const std::vector<GalleryJob>& jobs_;
    const std::vector<std::string>& hashes_;
    const GalleryFolder& folder_;
    GalleryRecord& record_;
    const BatchOptions options_;
    GalleryListener& listener_;
    Monitor monitor_;
    Publisher* publisher_ = nullptr;  ///< of the run
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
