// art/gallery/jobs.h: expands a gallery file, a manifest or a command line into a list of jobs.
#pragma once

#include "art/gallery/documents.h"
#include "art/gallery/keys.h"
#include "art/gallery/patterns.h"
#include "engine/base/hash.h"
#include "engine/interpreter.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sikku {

/// Maximum number of jobs; more are refused before they are expanded.
constexpr double most_gallery_jobs = 1'000'000;

/// Everything needed to make one file, on any machine at any time.
struct GalleryJob {
    std::string name;    ///< name of the file without extension; may contain folders
    std::string format;  ///< extension: svg, png, mid …; `notes.svg` is the score of `sikku play`
    const GalleryKeys* language = nullptr;  ///< must outlive the job
    std::shared_ptr<Documents> documents;   ///< shared by the jobs of a gallery
    std::shared_ptr<Works> works;           ///< shared by the jobs of a gallery
    std::shared_ptr<const GalleryPattern> pattern;
    std::map<std::string, std::string> keys;       ///< the given options of draw or play that apply to this job
    std::map<std::string, std::string> overrides;  ///< keys and defines of the pattern
    std::string place;                             ///< place of the request, `gallery.toml:3:1`; empty: command line
    std::filesystem::path folder;                  ///< folder of files named by the options

    /// The file's path below the folder of the gallery.
    std::string file() const { return name + "." + format; }
    /// The interpreter that makes it.
    const Interpreter& interpreter() const { return language->interpreter_of(format); }
    /// Its options, for the interpreter.
    OptionValues values() const;
    /// Those of its options that set keys of the pattern and name no file.
    std::vector<Setting> key_settings() const;
    /// Its pattern with its overrides, compiled once for all jobs with the same pattern and overrides; for a piece,
    /// the document of its first part. @throws PatternError, GalleryError
    Document document() const;
    /// The planned work, cached unless there are too many. @throws what Interpreter::plan() and document() throw
    std::shared_ptr<Work> work() const;
    /// The job as one line of JSON, which read_manifest() reads back. Equal jobs have equal texts.
    std::string text() const;
    /// Hash of everything that determines the contents of the file, as 32 hexadecimal digits: settings, pattern,
    /// files the pattern names, version of the program.
    std::string hash() const;
};

/// The request of a command line.
struct GalleryRequest {
    std::vector<std::string> patterns;  ///< names, globs, folders, files
    std::string gallery_file;
    std::string manifest;
    std::optional<std::string> gallery_text;   ///< replaces the gallery file, whose name is for messages
    std::optional<std::string> manifest_text;  ///< likewise
    bool bundled_only = false;                 ///< do not search files for patterns
    double most_jobs = most_gallery_jobs;      ///< more are refused; at most most_gallery_jobs
    std::map<std::string, std::string> keys;   ///< these override the files
    std::vector<std::string> overrides;        ///< KEY=VALUE
    std::string poster, contact;               ///< sizes of sheets; empty: taken from the gallery file
    Monitor monitor;                           ///< polled while jobs are listed
    std::string title;  ///< title of the page; empty: from the gallery file, or from its contents
};

/// Lists all jobs in the order of the request; an empty request lists all bundled patterns that draw.
/// Jobs are counted before any is expanded. Time and memory: linear in the files and the jobs.
/// @throws GalleryError with file, line and column for every error that can be detected before a pattern is compiled;
/// NotFound for an unknown pattern or gallery file; Stopped
std::vector<GalleryJob> gallery_jobs(GalleryRequest& request, const GalleryKeys& keys);

}  // namespace sikku
