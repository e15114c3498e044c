#include "cli/gallery_record.h"

#include "art/output_file.h"
#include "cli/gallery_jobs.h"
#include "cli/json.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>
#include <system_error>

namespace sikku {

/// What a record file holds, of each file the last line.
struct RecordText {
    std::map<std::string, FinishedJob> finished;
    std::set<std::string> claims;  ///< without a record after them
    bool is_ours = true;           ///< it is empty, or one line at least is a record, be it torn
    bool is_cut = false;           ///< its last line has no end
};

namespace {

[[noreturn]] void fail(const std::filesystem::path& file, int error) {
    throw std::runtime_error(
        fmt::format("cannot write '{}': {}", file.string(), std::generic_category().message(error)));
}

std::string contents(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

/// `gallery-3-of-8.jsonl`
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

RecordText read_record(const std::filesystem::path& file) {
    RecordText record;
    const std::string text = contents(file);
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
            if (json.contains("told")) job.told = json.at("told").get<std::vector<std::string>>();
            if (!is_inside(job.file)) continue;
            record.claims.erase(job.file);
            std::string name = job.file;
            record.finished[std::move(name)] = std::move(job);
        } catch (const nlohmann::json::exception&) {
            // Of others, with keys of other kinds.
        } catch (const JsonError&) {
            // Torn; what comes after it stands on a line of its own.
        }
    }
    return record;
}

/// What OutputFile adds to a name until the file is whole: `.NAME.abc234.tmp`, and of sound another such behind it.
/// Long names are cut to 200 bytes, not inside of a character.
bool is_unfinished(const std::string& name, std::string target) {
    if (target.size() > 200) {
        std::size_t end = 200;
        while (end > 0 && (static_cast<unsigned char>(target[end]) & 0xC0) == 0x80) --end;
        target.resize(end);
    }
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
    if (!told.empty()) json["told"] = told;
    return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

std::string content_hash(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    if (!stream) return "";
    TextHash hash;
    std::vector<char> block(std::size_t{1} << 16);
    while (stream) {
        stream.read(block.data(), static_cast<std::streamsize>(block.size()));
        hash.add({block.data(), static_cast<std::size_t>(stream.gcount())});
    }
    return stream.bad() ? "" : hash.digits();
}

GalleryRecord::GalleryRecord(std::filesystem::path folder, std::string name, bool replaces)
    : folder_(std::move(folder)), name_(std::move(name)) {
    std::error_code error;
    std::filesystem::create_directories(folder_, error);
    if (error && !std::filesystem::is_directory(folder_)) fail(folder_, error.value());
    open();
    const RecordText own = read_record(folder_ / name_);
    if (!own.is_ours && !replaces) {
        ::close(std::exchange(descriptor_, -1));
        throw std::runtime_error(fmt::format(
            "'{}' is there already and was not made by a gallery; --force replaces it", (folder_ / name_).string()));
    }
    // What is appended begins on a line of its own.
    if (own.is_cut) append("\n", false);
    remove_unfinished(name_);
    for (const auto& file : others()) take(read_record(file), false);
    take(own, true);
    for (const std::string& file : own.claims) remove_unfinished(file);
}

GalleryRecord::~GalleryRecord() {
    if (descriptor_ >= 0) ::close(descriptor_);
}

void GalleryRecord::open() {
    const std::filesystem::path file = folder_ / name_;
    while (true) {
        descriptor_ = ::open(file.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
        if (descriptor_ < 0) fail(file, errno);
        // Some network file systems have no locks: then it goes without.
        if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
            ::close(std::exchange(descriptor_, -1));
            throw std::runtime_error(fmt::format("another run is at work on '{}'", file.string()));
        }
        // Whoever held it may have put another file in its place.
        struct stat opened {};
        struct stat named {};
        if (::fstat(descriptor_, &opened) == 0 && ::stat(file.c_str(), &named) == 0 &&
            opened.st_ino == named.st_ino && opened.st_dev == named.st_dev) {
            return;
        }
        ::close(std::exchange(descriptor_, -1));
    }
}

/// The records of shards, and of the whole: all but the own one.
std::vector<std::filesystem::path> GalleryRecord::others() const {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
        const std::string found = entry.path().filename().string();
        if (found == name_ || !(found == "gallery.jsonl" || is_shard_name(found))) continue;
        if (!entry.is_symlink() && entry.is_regular_file()) files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    return files;
}

void GalleryRecord::take(const RecordText& record, bool keeps) {
    for (const std::string& claim : record.claims) {
        known_[claim].claimed = true;
        known_[claim].kept = known_[claim].kept || keeps;
    }
    for (const auto& [name, job] : record.finished) {
        known_[name].versions.push_back(job);
        known_[name].kept = known_[name].kept || keeps;
    }
}

void GalleryRecord::remove_unfinished(const std::string& file) const {
    const std::filesystem::path target = folder_ / file;
    std::error_code error;
    std::vector<std::filesystem::path> left;
    for (std::filesystem::directory_iterator entry(target.parent_path(), error), end; !error && entry != end;
         entry.increment(error)) {
        if (is_unfinished(entry->path().filename().string(), target.filename().string()))
            left.push_back(entry->path());
    }
    for (const auto& path : left) std::filesystem::remove(path, error);
}

std::optional<FinishedJob> GalleryRecord::present(const std::string& file) const {
    const auto found = known_.find(file);
    if (found == known_.end() || found->second.versions.empty()) return std::nullopt;
    const std::vector<FinishedJob>& versions = found->second.versions;
    const std::filesystem::path path = folder_ / file;
    struct stat status {};
    if (::stat(path.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return std::nullopt;
    const bool agree = std::all_of(versions.begin(), versions.end(), [&](const FinishedJob& version) {
        return version.hash == versions.front().hash && version.content == versions.front().content;
    });
    // A claim after the last record may have made it anew, from another pattern.
    const std::string content = agree && !found->second.claimed ? versions.back().content : content_hash(path);
    const auto same = std::find_if(versions.rbegin(), versions.rend(), [&](const FinishedJob& version) {
        return version.bytes == static_cast<std::uint64_t>(status.st_size) && version.content == content;
    });
    return same == versions.rend() ? std::nullopt : std::optional(*same);
}

std::optional<FinishedJob> GalleryRecord::finished(const std::string& file, const std::string& hash) const {
    auto job = present(file);
    return job && job->hash == hash ? job : std::nullopt;
}

bool GalleryRecord::is_ours(const std::string& file) const {
    return known_.contains(file);
}

void GalleryRecord::append(const std::string& line, bool durable) {
    const std::lock_guard guard(mutex_);
    while (true) {
        const ssize_t written = ::write(descriptor_, line.data(), line.size());
        if (written == static_cast<ssize_t>(line.size())) break;
        if (written < 0 && errno == EINTR) continue;
        // A disk that is full may take a part: the rest of that line then counts for nothing.
        const int error = written < 0 ? errno : ENOSPC;
        if (written > 0 && ::write(descriptor_, "\n", 1) != 1) {
            // It is torn at its end, as read() expects.
        }
        fail(folder_ / name_, error);
    }
    if (durable && ::fdatasync(descriptor_) != 0 && errno != EINVAL && errno != EROFS) fail(folder_ / name_, errno);
}

void GalleryRecord::claim(const std::string& file) {
    append(claim_line(file), false);
}

void GalleryRecord::add(const FinishedJob& job) {
    // OutputFile has synchronised the file: what the record says of it holds whatever happens.
    append(job.line(), true);
}

void GalleryRecord::complete(const std::vector<FinishedJob>& order, bool sole) {
    /// Records of shards that no run is at work on, locked until they are gone.
    struct Locked {
        std::filesystem::path file;
        int descriptor = -1;
    };
    std::vector<Locked> shards;
    if (sole) {
        for (const auto& file : others()) {
            const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
            if (descriptor < 0) continue;
            // Shards may have finished since this run began: only now it is known what they hold.
            const bool is_free = ::flock(descriptor, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK;
            const RecordText shard = read_record(file);
            if (!is_free || !shard.is_ours) {
                ::close(descriptor);
                continue;
            }
            shards.push_back({file, descriptor});
            take(shard, true);
            for (const std::string& claim : shard.claims) remove_unfinished(claim);
            remove_unfinished(file.filename().string());
        }
    }
    std::string text;
    std::set<std::string> written;
    for (const FinishedJob& job : order) {
        text += job.line();
        written.insert(job.file);
    }
    // Of other jobs, what is still there, also what was not finished: it is no file of others.
    for (const auto& [file, known] : known_) {
        std::error_code error;
        if (written.contains(file) || !known.kept || !std::filesystem::exists(folder_ / file, error)) continue;
        if (const auto job = present(file)) {
            text += job->line();
        } else {
            text += claim_line(file);
        }
    }
    OutputFile output(folder_ / name_);
    output.write(text);
    output.commit();
    for (const Locked& shard : shards) {
        ::unlink(shard.file.c_str());
        ::close(shard.descriptor);
    }
}

}  // namespace sikku
