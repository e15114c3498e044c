#include "art/gallery/publisher.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <iterator>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace sikku {

MadeFile make_gallery_file(GalleryRecord& record, const GalleryFolder& folder, FinishedJob file, bool replaces,
                           const FileMaker& make) {
    GalleryPlace held = folder.place(file.file);
    MadeFile made{std::move(file), std::move(held), {}};
    FinishedJob& job = made.file;
    const GalleryPlace& place = made.place;
    const auto there = place.status();
    if (there && !replaces) {
        throw std::runtime_error(fmt::format(
            "'{}' already exists and was not made by this gallery; 'force' replaces it", folder.shown(job.file)));
    }
    // Check the link itself, not its target.
    if (there && !S_ISREG(there->st_mode) && !S_ISDIR(there->st_mode)) place.remove();
    record.claim(job.file);
    try {
        make(place.path(), made.outputs, job);
    } catch (const Stopped&) {
        throw;
    } catch (const std::runtime_error& error) {
        throw std::runtime_error(place.readable(error.what()));
    }
    for (std::string& line : job.warnings) line = place.readable(line, job.file);
    for (std::string& line : job.told) line = place.readable(line, job.file);
    const std::filesystem::path name = made.outputs.temporary(place.path()).filename();
    const std::string written = (std::filesystem::path(job.file).parent_path() / name).string();
    const auto status = name.empty() ? std::nullopt : folder.status(written);
    if (!status) throw std::runtime_error("nothing to write");
    job.bytes = static_cast<std::uint64_t>(status->st_size);
    job.content = folder.content_hash(written);
    return made;
}

void publish_gallery_file(GalleryRecord& record, MadeFile& made) {
    try {
        record.synchronise();
        made.outputs.commit();
    } catch (const std::runtime_error& error) {
        throw std::runtime_error(made.place.readable(error.what()));
    }
    try {
        const FinishedJob* const job = &made.file;
        record.add(std::span(&job, 1));
    } catch (const std::runtime_error&) {
        made.place.remove();
        throw;
    }
}

std::size_t Publisher::most_waiting() {
    constexpr rlim_t most = 100;
    struct rlimit files {};
    if (::getrlimit(RLIMIT_NOFILE, &files) != 0) return most;
    // Two descriptors each, and as many files are being published: half of the limit.
    return static_cast<std::size_t>(std::clamp<rlim_t>(files.rlim_cur / 8, 1, most));
}

Publisher::Publisher(GalleryRecord& record) : record_(record) {
    try {
        thread_ = std::thread([this] { work(); });
    } catch (const std::system_error&) {
        // Files are published by the threads that make them.
    }
}

Publisher::~Publisher() {
    end();
}

void Publisher::add(MadeFile file, Done done) {
    std::vector<Waiting> alone;
    {
        std::unique_lock lock(mutex_);
        if (thread_.joinable()) {
            changed_.wait(lock, [&] { return error_ || waiting_.size() < most_waiting_; });
            if (error_) std::rethrow_exception(error_);
            waiting_.push_back({std::move(file), std::move(done)});
            changed_.notify_all();
            return;
        }
    }
    alone.push_back({std::move(file), std::move(done)});
    publish(std::move(alone));
}

void Publisher::finish() {
    end();
    if (error_) std::rethrow_exception(error_);
}

void Publisher::end() {
    {
        const std::lock_guard guard(mutex_);
        ends_ = true;
    }
    changed_.notify_all();
    if (thread_.joinable()) thread_.join();
}

void Publisher::work() noexcept {
    try {
        publish_all();
    } catch (...) {
        // For example, too little memory for a message.
        {
            const std::lock_guard guard(mutex_);
            error_ = std::current_exception();
        }
        changed_.notify_all();
    }
}

void Publisher::publish_all() {
    while (true) {
        std::vector<Waiting> group;
        {
            std::unique_lock lock(mutex_);
            changed_.wait(lock, [&] { return ends_ || !waiting_.empty(); });
            if (waiting_.empty()) return;
            group = std::exchange(waiting_, {});
        }
        changed_.notify_all();
        publish(std::move(group));
    }
}

void Publisher::publish(std::vector<Waiting> group) {
    bool is_done = false;
    try {
        std::vector<OutputFiles*> outputs;
        std::vector<const FinishedJob*> jobs;
        for (Waiting& each : group) {
            outputs.push_back(&each.made.outputs);
            jobs.push_back(&each.made.file);
        }
        record_.synchronise();
        OutputFiles::commit(outputs);
        record_.add(jobs);
        is_done = true;
    } catch (const std::exception&) {
        // One by one, to find out which of them cannot be published.
    }
    for (Waiting& each : group) {
        std::string problem;
        try {
            if (!is_done) publish_gallery_file(record_, each.made);
        } catch (const std::exception& error) {
            problem = *error.what() ? error.what() : "unknown error";
        }
        each.done(std::move(each.made.file), std::move(problem));
    }
}

}  // namespace sikku
