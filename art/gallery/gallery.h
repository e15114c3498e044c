// art/gallery/gallery.h: makes a gallery: prints and scores in one folder, in parallel, resumed at any time.
#pragma once

#include "art/gallery/forecast.h"
#include "art/gallery/job_result.h"
#include "art/gallery/jobs.h"
#include "art/gallery/shards.h"
#include "engine/base/monitor.h"

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace sikku {

struct GalleryOptions {
    std::filesystem::path folder = "gallery";
    std::vector<std::string> only{};  ///< names or files of jobs to make again; empty: all missing ones
    bool force = false;               ///< make all jobs again, and replace files that the gallery did not make
    bool keep_going = false;          ///< make other jobs after one failed
    double memory = 1e9;              ///< maximum memory in bytes; jobs wait for it
    int threads = 0;                  ///< jobs at a time; 0: one for each core
    Shard shard{};
    bool exact = false;  ///< forecasts report the length of each word to the last digit
};

/// Result of a run.
struct GalleryResult {
    std::map<std::size_t, FinishedJob> finished;  ///< all selected jobs that are finished, by number
    std::vector<std::size_t> made;                ///< numbers of the jobs made by this run
    std::vector<Failure> failures;
    std::vector<std::string> warnings;  ///< about the sheets made, with their names
    std::vector<std::string> troubles;  ///< why sheets, the page or the record could not be written
    std::size_t left = 0;               ///< jobs that were not begun
    std::string record;                 ///< name of the record file, for messages
};

/// The jobs of a request, and the operations on them.
class Gallery {
public:
    /// @param keys  must outlive the gallery
    /// @throws GalleryError for every error that can be detected before anything is made; NotFound for an unknown
    /// pattern or gallery file; Stopped
    Gallery(GalleryRequest request, GalleryOptions options, const GalleryKeys& keys, const Monitor& monitor);

    const std::vector<GalleryJob>& jobs() const { return jobs_; }
    /// Numbers of the jobs of this shard and of `only`.
    const std::vector<std::size_t>& chosen() const { return chosen_; }
    /// Memory for jobs in bytes, without that of the program itself.
    double memory() const { return memory_; }
    /// The forecast of a selected job; the first call computes all of them.
    const JobForecast& forecast(std::size_t job);
    /// Forecasts of the requested sheets: file and memory, or why the sheet cannot be made.
    /// @param jobs  jobs that can be made
    std::vector<std::pair<std::string, JobForecast>> sheet_forecasts(
        const std::vector<const GalleryJob*>& jobs) const;

    /// Makes all missing jobs, then the page and the sheets. A stop request ends it early, without an exception
    /// once jobs have begun. @throws Stopped; std::runtime_error if the folder cannot be used
    GalleryResult make(GalleryListener& listener);

private:
    void forecast_all(const std::vector<std::size_t>& wanted);
    void select();

    GalleryRequest request_;
    GalleryOptions options_;
    Monitor monitor_;
    std::vector<GalleryJob> jobs_;
    std::vector<std::optional<JobForecast>> forecasts_;
    std::vector<std::size_t> chosen_;
    double memory_ = 0;
};

}  // namespace sikku
