// art/gallery/job_result.h: results of the jobs of a gallery, and progress reports.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace sikku {

/// Facts about a finished file. They do not depend on when or how fast it was made.
struct FinishedJob {
    std::string file;         ///< path below the folder
    std::string hash;         ///< GalleryJob::hash()
    std::uint64_t bytes = 0;  ///< size of the file
    std::string content;      ///< hash of the file's bytes
    std::string job;          ///< GalleryJob::text()
    std::vector<std::string> warnings;
    std::vector<std::string> told;  ///< facts

    /// One line of JSON, with its line feed.
    std::string line() const;
    bool operator==(const FinishedJob&) const = default;
};

/// A job that could not be made.
struct Failure {
    std::size_t job = 0;
    std::string message;
};

/// Receives progress reports of a gallery. Calls may come from several threads at once.
class GalleryListener {
public:
    virtual ~GalleryListener() = default;
    /// @param cost  seconds on one core, roughly
    virtual void begin(std::size_t /*jobs*/, double /*cost*/) {}
    /// A job has ended, successfully or not.
    virtual void finish(double /*cost*/) {}
    /// Called regularly while jobs are in progress.
    virtual void watch() {}
    virtual void end() {}
    /// Another run is making that many jobs; this run waits for them.
    virtual void wait_for_jobs(std::size_t /*jobs*/) {}
    /// Another run is using the record; this run waits for it.
    virtual void wait_for_record(const std::string& /*record*/) {}
    /// A sheet or the page is being made.
    virtual void sheet(const std::string& /*name*/) {}
};

}  // namespace sikku
