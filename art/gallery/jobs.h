// art/gallery/jobs.h: what a gallery is to hold, as a plain list of jobs: from a gallery file, a manifest, a command
// line.
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

/// More jobs are refused before they are expanded.
constexpr double most_gallery_jobs = 1'000'000;

/// Everything that it takes to make one file, whoever makes it, wherever and when.
struct GalleryJob {
    std::string name;    ///< of the file, without the ending; `/` leads into folders
    std::string format;  ///< the ending: svg, png, mid …; `notes.svg` is the score of `sikku play`
    const GalleryKeys* language = nullptr;  ///< must outlive the job
    std::shared_ptr<Documents> documents;   ///< shared by the jobs of a gallery
    std::shared_ptr<Works> works;           ///< likewise
    std::shared_ptr<const GalleryPattern> pattern;
    std::map<std::string, std::string> keys;       ///< options of draw and play that were given and matter here
    std::map<std::string, std::string> overrides;  ///< keys and defines of the pattern
    std::string place;             ///< where it was asked for, `gallery.toml:3:1`; empty: command line
    std::filesystem::path folder;  ///< what its options name lies here

    /// The file's path below the folder of the gallery.
    std::string file() const { return name + "." + format; }
    /// What makes it.
    const Interpreter& interpreter() const { return language->interpreter_of(format); }
    /// Its options, for the interpreter.
    OptionValues values() const;
    /// Its pattern with its overrides, compiled once for all jobs that have the same. @throws PatternError,
    /// GalleryError
    Document document() const;
    /// Planned once, unless there are too many to keep. @throws what Interpreter::plan() and document() throw
    std::shared_ptr<Work> work() const;
    /// Canonical: equal jobs have equal texts. One line of JSON, which read_manifest() reads back.
    std::string text() const;
    /// 32 hexadecimal digits of all that decides what the file holds: settings, pattern, files the pattern names,
    /// version of the program.
    std::string hash() const;
};

/// What the command line asks for.
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
    std::string title;                         ///< of the page; empty: from the gallery file, or its contents
};

/// All jobs in the order of what was asked for; with nothing asked for, all patterns that come along and draw.
/// Jobs are counted before any is expanded. Time and memory: linear in the files and the jobs.
/// @throws GalleryError with file, line and column for every error that can be detected before a pattern is compiled;
/// Stopped
std::vector<GalleryJob> gallery_jobs(GalleryRequest& request, const GalleryKeys& keys);

}  // namespace sikku
