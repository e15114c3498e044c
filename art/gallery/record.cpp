#include "art/gallery/record.h"

#include "engine/base/json.h"
#include "engine/base/output_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>
#include <system_error>
#include <thread>
#include <utility>

namespace sikku {

/// The contents of a record file: the last line for each file.
struct RecordText {
    std::map<std::string, FinishedJob> finished;
    std::set<std::string> claims;  ///< without a record after them
    bool is_ours = true;           ///< it is empty, or at least one line is a record, even if torn
    bool is_cut = false;           ///< its last line has no end
};

namespace {

constexpr std::string_view whole_name = "gallery.jsonl";

/// True for names such as `gallery-3-of-8.jsonl`.
bool is_shard_name(std::string_view name) {
    const auto take_number = [&] {
        const std::size_t digits = std::min(name.find_first_not_of("0123456789"), name.size());
        name.remove_prefix(digits);
        return digits > 0;
    };
    const auto take = [&](std::string_view piece) {
        if (!name.starts_with(piece)) return false;
        name.remove_prefix(piece.size());
        return true;
    };
    return take("gallery-") && take_number() && take("-of-") && take_number() && name == ".jsonl";
}

/// Records of others must not lead out of the folder.
bool is_inside(const std::filesystem::path& file) {
    return !file.empty() && file.is_relative() && file.has_filename() &&
           std::none_of(file.begin(), file.end(), [](const auto& part) { return part == ".."; });
}

RecordText read_record(const std::string& text) {
    RecordText record;
    record.is_ours = text.empty();
    record.is_cut = !text.empty() && !text.ends_with('\n');
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        const std::string line = text.substr(at, end - at);
        at = end + 1;
        record.is_ours = record.is_ours || line.starts_with("{\"claim\":") || line.starts_with("{\"file\":");
        try {
            const auto json = read_json(line);
            if (json.contains("claim")) {
                const auto claim = json.at("claim").get<std::string>();
                if (is_inside(claim)) record.claims.insert(claim);
                continue;
            }
            FinishedJob job;
            job.file = json.at("file").get<std::string>();
            job.hash = json.at("hash").get<std::string>();
            job.bytes = json.at("bytes").get<std::uint64_t>();
            job.content = json.at("content").get<std::string>();
            job.job = json.at("job").dump();
            if (json.contains("warnings")) job.warnings = json.at("warnings").get<std::vector<std::string>>();
            if (json.contains("told")) job.told = json.at("told").get<std::vector<std::string>>();
            if (!is_inside(job.file)) continue;
            record.claims.erase(job.file);
            std::string name = job.file;
            record.finished[std::move(name)] = std::move(job);
        } catch (const nlohmann::json::exception&) {
            // Another program's line, with keys of other kinds.
        } catch (const JsonError&) {
            // A torn line; the text after it is on a line of its own.
        }
    }
    return record;
}

/// True for a name that OutputFile uses until the file is whole: `.NAME.abc234.tmp`, for sound with another such
/// suffix. Long names are cut to 200 bytes, not inside of a character.
bool is_unfinished(const std::string& name, const std::string& target) {
    // Several files may share a shortened name, and another run may be making one of them.
    if (target.size() > 200) return false;
    std::string_view rest = name;
    const auto take = [&](std::string_view piece) {
        if (!rest.starts_with(piece)) return false;
        rest.remove_prefix(piece.size());
        return true;
    };
    const auto take_letters = [&] {
        constexpr std::string_view letters = "abcdefghijklmnopqrstuvwxyz234567";
        for (int i = 0; i < 6; ++i, rest.remove_prefix(1)) {
            if (rest.empty() || letters.find(rest[0]) == std::string_view::npos) return false;
        }
        return true;
    };
    if (!take(".")) return false;
    take(".");
    if (!take(target) || !take(".") || !take_letters() || !take(".tmp")) return false;
    return rest.empty() || rest == ".mid" || (take(".mid.") && take_letters() && take(".tmp") && rest.empty());
}

/// Files by their names in a folder.
using NamedFiles = std::map<std::string, std::string>;

/// The file that has an unfinished part of this name; end() if none has. Looks up only the parts of `name` before its
/// dots: a gallery may have many files.
NamedFiles::const_iterator owner_of(const std::string& name, const NamedFiles& files) {
    for (std::size_t dot = name.find('.', 2); dot != std::string::npos; dot = name.find('.', dot + 1)) {
        for (const std::size_t begin : {1, 2}) {
            const auto found = files.find(name.substr(begin, dot - begin));
            if (found != files.end() && is_unfinished(name, found->first)) return found;
        }
    }
    return files.end();
}

/// Reads an open file from a byte on, but stops after 1 MB without a line feed, longer than any line of a record.
/// @throws std::runtime_error for over 1 GB
std::string read_from(const Descriptor& file, off_t from) {
    constexpr std::size_t longest_line = std::size_t{1} << 20;
    constexpr std::size_t most_bytes = std::size_t{1} << 30;
    std::string text;
    std::size_t line_begin = 0;
    std::vector<char> block(std::size_t{1} << 16);
    while (true) {
        const ssize_t got = ::pread(file.get(), block.data(), block.size(), from + static_cast<off_t>(text.size()));
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) throw std::system_error(errno, std::generic_category(), "cannot read the record of a gallery");
        if (got == 0) return text;
        text.append(block.data(), static_cast<std::size_t>(got));
        const std::size_t line_end = text.rfind('\n');
        if (line_end != std::string::npos) line_begin = line_end + 1;
        if (text.size() - line_begin > longest_line) return text;
        if (text.size() > most_bytes) throw std::runtime_error("the record of a gallery exceeds 1 GB");
    }
}

/// The folder below that of the gallery in which a file lies.
std::string folder_of(const std::string& file) {
    return std::filesystem::path(file).parent_path().string();
}

std::string claim_line(const std::string& file) {
    nlohmann::json json;
    json["claim"] = file;
    return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

}  // namespace

std::string FinishedJob::line() const {
    nlohmann::ordered_json json;
    json["file"] = file;
    json["hash"] = hash;
    json["bytes"] = bytes;
    json["content"] = content;
    json["job"] = read_json(job);
    if (!warnings.empty()) json["warnings"] = warnings;
    if (!told.empty()) json["told"] = told;
    return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

GalleryRecord::GalleryRecord(const GalleryFolder& folder, std::string name, bool replaces,
                             const std::function<void()>& waiting)
    : folder_(folder), name_(std::move(name)), descriptor_(open(waiting)), locks_(folder) {
    const GalleryLocks::Turn turn(locks_, false);
    const RecordText own = read_record(read_from(descriptor_, 0));
    if (!own.is_ours && !replaces) {
        throw std::runtime_error(fmt::format("'{}' already exists and was not made by a gallery; 'force' replaces it",
                                             folder_.shown(name_)));
    }
    // Appended records begin on a line of their own.
    if (own.is_cut) append("\n");
    arrivals_ = locks_.arrivals();
    others_were_present_ = locks_.others_present();
    for (const std::string& file : others()) others_.try_emplace(file);
    read_others();
    take_in(own, true);
    left_ = own.claims;
    left_.insert(name_);
    remove_left();
}

/// Waits for other runs of the same shard, and opens the record.
Descriptor GalleryRecord::open(const std::function<void()>& waiting) const {
    while (true) {
        Descriptor record = folder_.create(name_, O_RDWR | O_APPEND);
        // Some network file systems do not support locks, and the record is used without.
        while (::flock(record.get(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
            waiting();
            std::this_thread::sleep_for(std::chrono::milliseconds(100));
        }
        // The previous holder may have replaced the file.
        struct stat opened {};
        const auto named = folder_.status(name_);
        if (named && ::fstat(record.get(), &opened) == 0 && opened.st_ino == named->st_ino &&
            opened.st_dev == named->st_dev) {
            return record;
        }
        waiting();
    }
}

/// The records of shards and of the whole, except that of this run.
std::vector<std::string> GalleryRecord::others() const {
    std::vector<std::string> files = folder_.names();
    std::erase_if(files, [&](const std::string& file) {
        return file == name_ || !(file == whole_name || is_shard_name(file));
    });
    return files;
}

/// True if this is still the file that was read, and not another one with the same inode number.
bool GalleryRecord::continues(const Descriptor& record, const Reading& reading) {
    std::string end(reading.end.size(), '\0');
    const off_t at = reading.bytes - static_cast<off_t>(end.size());
    return ::pread(record.get(), end.data(), end.size(), at) == static_cast<ssize_t>(end.size()) &&
           end == reading.end;
}

/// Reads the unread parts of the records of other runs.
void GalleryRecord::read_others() {
    for (auto& [file, reading] : others_) {
        const Descriptor record = folder_.open(file);
        struct stat status {};
        // A missing file was merged: its lines are in the record of the whole gallery.
        if (!record || ::fstat(record.get(), &status) != 0) continue;
        if (status.st_ino != reading.inode || status.st_size < reading.bytes || !continues(record, reading)) {
            reading = {status.st_ino, 0, {}};
        }
        if (status.st_size == reading.bytes) continue;
        std::string text = read_from(record, reading.bytes);
        // A line without end may still be written.
        text.resize(text.rfind('\n') == std::string::npos ? 0 : text.rfind('\n') + 1);
        if (text.empty()) continue;
        reading.bytes += static_cast<off_t>(text.size());
        constexpr std::size_t compared = 512;
        reading.end = text.substr(text.size() - std::min(text.size(), compared));
        take_in(read_record(text), false);
    }
}

void GalleryRecord::take_in(const RecordText& record, bool keeps) {
    for (const std::string& claim : record.claims) {
        known_[claim].claimed = true;
        known_[claim].kept = known_[claim].kept || keeps;
    }
    for (const auto& entry : record.finished) {
        const FinishedJob& job = entry.second;
        Known& known = known_[entry.first];
        std::erase_if(known.versions, [&](const FinishedJob& version) { return version == job; });
        known.versions.push_back(job);
        known.kept = known.kept || keeps;
    }
}

void GalleryRecord::refresh() {
    const std::lock_guard guard(mutex_);
    const bool present = locks_.others_present();
    const std::uint64_t arrivals = locks_.arrivals();
    if (!std::exchange(others_were_present_, present) && !present && arrivals == arrivals_) return;
    const GalleryLocks::Turn turn(locks_, false);
    if (arrivals != arrivals_) {
        for (const std::string& file : others()) others_.try_emplace(file);
    }
    arrivals_ = arrivals;
    read_others();
}

/// Removes the unfinished parts of the files in `left_`, except those that another run is making.
void GalleryRecord::remove_left() {
    std::map<std::string, NamedFiles> by_folder;
    for (const std::string& file : left_) {
        by_folder[folder_of(file)].emplace(std::filesystem::path(file).filename().string(), file);
    }
    left_.clear();
    // Without locks it is unknown whether the owner is still running.
    if (!locks_.work()) return;
    for (const auto& [below, files] : by_folder) {
        for (const std::string& name : folder_.names(below)) {
            if (!name.starts_with(".")) continue;
            const auto owner = owner_of(name, files);
            if (owner == files.end()) continue;
            const std::string& file = owner->second;
            if (!locks_.take(file)) {
                left_.insert(file);
                continue;
            }
            folder_.remove((std::filesystem::path(below) / name).string());
            locks_.release(file);
        }
    }
}

std::optional<FinishedJob> GalleryRecord::present(const std::string& file) const {
    Known known;
    {
        const std::lock_guard guard(mutex_);
        const auto found = known_.find(file);
        if (found == known_.end()) return std::nullopt;
        known = found->second;
    }
    return present(file, known);
}

std::optional<FinishedJob> GalleryRecord::present(const std::string& file, const Known& known) const {
    const std::vector<FinishedJob>& versions = known.versions;
    const auto status = folder_.status(file);
    if (versions.empty() || !status || !S_ISREG(status->st_mode)) return std::nullopt;
    const bool agree = std::all_of(versions.begin(), versions.end(), [&](const FinishedJob& version) {
        return version.hash == versions.front().hash && version.content == versions.front().content;
    });
    // A claim after the last record may have made it anew, from another pattern.
    const std::string content = agree && !known.claimed ? versions.back().content : folder_.content_hash(file);
    const auto same = std::find_if(versions.rbegin(), versions.rend(), [&](const FinishedJob& version) {
        return version.bytes == static_cast<std::uint64_t>(status->st_size) && version.content == content;
    });
    return same == versions.rend() ? std::nullopt : std::optional(*same);
}

std::optional<FinishedJob> GalleryRecord::finished(const std::string& file, const std::string& hash) const {
    auto job = present(file);
    return job && job->hash == hash ? job : std::nullopt;
}

bool GalleryRecord::is_ours(const std::string& file) const {
    const std::lock_guard guard(mutex_);
    return known_.contains(file);
}

bool GalleryRecord::is_begun(const std::string& file) const {
    const std::lock_guard guard(mutex_);
    const auto found = known_.find(file);
    return found != known_.end() && found->second.claimed;
}

void GalleryRecord::append(const std::string& text) {
    while (true) {
        const ssize_t written = ::write(descriptor_.get(), text.data(), text.size());
        if (written == static_cast<ssize_t>(text.size())) break;
        if (written < 0 && errno == EINTR) continue;
        // A full disk may accept part of the line, which then does not count.
        const int error = written < 0 ? errno : ENOSPC;
        if (written > 0 && ::write(descriptor_.get(), "\n", 1) != 1) {
            // The line is torn at its end, as read_record() expects.
        }
        cannot_write(folder_.shown(name_), error);
    }
}

void GalleryRecord::synchronise() {
    // Claims may be appended meanwhile.
    if (::fdatasync(descriptor_.get()) != 0 && errno != EINVAL && errno != EROFS) {
        cannot_write(folder_.shown(name_), errno);
    }
}

void GalleryRecord::claim(const std::string& file) {
    const std::lock_guard guard(mutex_);
    append(claim_line(file));
    // A killed run whose record was damaged may have left unfinished parts of it.
    left_.insert(file);
}

void GalleryRecord::add(std::span<const FinishedJob* const> jobs) {
    std::string lines;
    for (const FinishedJob* job : jobs) lines += job->line();
    {
        const std::lock_guard guard(mutex_);
        append(lines);
    }
    synchronise();
}

/// Locks the shard records that no run is using and reads their current contents.
std::vector<GalleryRecord::Left> GalleryRecord::take_over_shards() {
    std::vector<Left> shards;
    for (const std::string& file : others()) {
        if (file == whole_name || !folder_.open(file)) continue;
        Left shard{file, {}};
        try {
            shard.descriptor = folder_.create(file, O_RDWR);
        } catch (const std::runtime_error&) {
            continue;
        }
        // Without locks, only records with nothing in progress.
        const bool is_locked = ::flock(shard.descriptor.get(), LOCK_EX | LOCK_NB) == 0;
        if (!is_locked && errno == EWOULDBLOCK) continue;
        const RecordText record = read_record(read_from(shard.descriptor, 0));
        if (!record.is_ours || (!is_locked && !record.claims.empty())) continue;
        take_in(record, true);
        left_.insert(record.claims.begin(), record.claims.end());
        left_.insert(file);
        shards.push_back(std::move(shard));
    }
    return shards;
}

/// True if the record of the whole gallery contains all these files unchanged.
bool GalleryRecord::is_in_the_whole(const std::vector<FinishedJob>& jobs) const {
    if (!folder_.open(std::string(whole_name))) return false;
    const RecordText whole = read_record(folder_.read(std::string(whole_name)));
    return std::all_of(jobs.begin(), jobs.end(), [&](const FinishedJob& job) {
        const auto found = whole.finished.find(job.file);
        return found != whole.finished.end() && found->second == job && !whole.claims.contains(job.file);
    });
}

void GalleryRecord::complete(const std::vector<FinishedJob>& order, const std::vector<std::string>& begun,
                             bool sole) {
    const std::lock_guard guard(mutex_);
    const GalleryLocks::Turn turn(locks_, true);
    const std::vector<Left> shards = sole ? take_over_shards() : std::vector<Left>();
    remove_left();
    std::vector<FinishedJob> jobs = order;
    std::set<std::string> claims(begun.begin(), begun.end());
    claims.insert(left_.begin(), left_.end());
    std::set<std::string> written;
    for (const FinishedJob& job : order) {
        written.insert(job.file);
        claims.erase(job.file);
    }
    // Files of other jobs that still exist, finished or not: they belong to this gallery.
    for (const auto& [file, known] : known_) {
        if (written.contains(file) || !known.kept || !folder_.status(file)) continue;
        if (auto job = present(file, known)) {
            jobs.push_back(std::move(*job));
        } else {
            claims.insert(file);
        }
    }
    if (!sole && claims.empty() && is_in_the_whole(jobs)) {
        folder_.remove(name_);
    } else {
        std::string text;
        for (const FinishedJob& job : jobs) text += job.line();
        for (const std::string& file : claims) text += claim_line(file);
        replace(text);
    }
    for (const Left& shard : shards) folder_.remove(shard.name);
    // Release it before the lock of the records, so that another run may merge it.
    descriptor_.reset();
}

void GalleryRecord::replace(const std::string& text) const {
    folder_.write(name_, text);
}

}  // namespace sikku
