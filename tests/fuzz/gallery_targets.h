// tests/fuzz/gallery_targets.h: what the fuzzers do with any bytes as a gallery file or a manifest.
#pragma once

#include "art/gallery/jobs.h"
#include "art/gallery/values.h"
#include "art/prints.h"
#include "music/scores.h"
#include "tests/fuzz/targets.h"

#include <set>
#include <string>
#include <string_view>

namespace sikku {

/// Expands a gallery file into a list of jobs, with bundled patterns only. Errors are GalleryErrors; jobs have
/// distinct files below the gallery's folder, and their texts are read back as the same jobs.
inline void try_gallery(GalleryRequest request) {
    static const GalleryKeys keys({&prints(), &scores()});
    constexpr std::size_t most_read_back = 50;
    request.bundled_only = true;
    request.most_jobs = 20'000;  // a million jobs take 11 s under sanitizers, too long for a fuzzer
    try {
        const std::vector<GalleryJob> jobs = gallery_jobs(request, keys);
        require(static_cast<double>(jobs.size()) <= request.most_jobs, "more jobs than are allowed");
        std::set<std::string> files;
        std::string manifest;
        for (const GalleryJob& job : jobs) {
            const std::string file = job.file();
            require(files.insert(file).second, "two jobs have the same file: " + file);
            require(is_utf8(file) && !file.starts_with('/') && ("/" + file).find("/.") == std::string::npos,
                    "a file lies outside the gallery: " + file);
            if (jobs.size() <= most_read_back) manifest += job.text() + '\n';
        }
        if (jobs.size() > most_read_back) return;
        GalleryRequest again;
        again.manifest = "again.jsonl";
        again.manifest_text = manifest;
        again.bundled_only = true;
        const std::vector<GalleryJob> same = gallery_jobs(again, keys);
        require(same.size() == jobs.size(), "a manifest of the jobs has another number of them");
        for (std::size_t i = 0; i < jobs.size(); ++i) {
            require(same[i].file() == jobs[i].file(), "a job reads back with another file: " + jobs[i].text());
        }
    } catch (const GalleryError& error) {
        require(is_utf8(error.what()), "a message is not valid UTF-8");
    }
}

inline void try_gallery_toml(std::string_view bytes) {
    GalleryRequest request;
    request.gallery_file = "fuzz.toml";
    request.gallery_text = std::string(bytes);
    try_gallery(std::move(request));
}

inline void try_gallery_jsonl(std::string_view bytes) {
    GalleryRequest request;
    request.manifest = "fuzz.jsonl";
    request.manifest_text = std::string(bytes);
    try_gallery(std::move(request));
}

}  // namespace sikku
