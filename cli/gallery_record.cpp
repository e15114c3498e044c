#include "cli/gallery_record.h"

#include "art/output_file.h"
#include "cli/gallery_jobs.h"

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
namespace {

[[noreturn]] void fail(const std::filesystem::path& file, int error) {
    throw std::runtime_error(
        fmt::format("cannot write '{}': {}", file.string(), std::generic_category().message(error)));
}

std::string contents(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

bool is_record_name(const std::string& name) {
    return name.starts_with("gallery") && name.ends_with(".jsonl");
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

void synchronise(const std::filesystem::path& file) {
    const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0) return;
    ::fsync(descriptor);
    ::close(descriptor);
}

}  // namespace

std::string FinishedJob::line() const {
    nlohmann::ordered_json json;
    json["file"] = file;
    json["hash"] = hash;
    json["bytes"] = bytes;
    json["content"] = content;
    json["job"] = nlohmann::ordered_json::parse(job);
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

GalleryRecord::GalleryRecord(std::filesystem::path folder, std::string name)
    : folder_(std::move(folder)), name_(std::move(name)) {
    std::error_code error;
    std::filesystem::create_directories(folder_, error);
    if (error && !std::filesystem::is_directory(folder_)) fail(folder_, error.value());
    open();
    std::vector<std::filesystem::path> files;
    std::vector<std::filesystem::path> unfinished;
    for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
        const std::string found = entry.path().filename().string();
        if (is_record_name(found) && entry.is_regular_file()) files.push_back(entry.path());
        if (is_unfinished(found, name_)) unfinished.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    for (const auto& file : files) read(file, file.filename() == name_);
    for (const auto& file : unfinished) std::filesystem::remove(file, error);
    for (const auto& [file, known] : known_) {
        if (known.claimed_here) remove_unfinished(file);
    }
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

void GalleryRecord::read(const std::filesystem::path& file, bool own) {
    const std::string text = contents(file);
    std::map<std::string, FinishedJob> last;
    std::set<std::string> claims;
    bool all_records = true;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = text.find('\n', at);
        const std::string line = text.substr(at, end - at);
        at = end == std::string::npos ? text.size() : end + 1;
        try {
            const auto json = nlohmann::json::parse(line);
            if (json.contains("claim")) {
                claims.insert(json.at("claim").get<std::string>());
                continue;
            }
            FinishedJob job;
            job.file = json.at("file").get<std::string>();
            job.hash = json.at("hash").get<std::string>();
            job.bytes = json.at("bytes").get<std::uint64_t>();
            job.content = json.at("content").get<std::string>();
            job.job = json.at("job").dump();
            if (json.contains("told")) job.told = json.at("told").get<std::vector<std::string>>();
            claims.erase(job.file);
            std::string name = job.file;
            last[std::move(name)] = std::move(job);
        } catch (const nlohmann::json::exception&) {
            // Torn; what comes after it stands on a line of its own.
            all_records = all_records && end == std::string::npos;
        }
    }
    for (const std::string& claim : claims) {
        known_[claim].claimed = true;
        known_[claim].claimed_here = known_[claim].claimed_here || own;
    }
    for (auto& [name, job] : last) {
        known_[name].versions.push_back(std::move(job));
        known_[name].recorded_here = known_[name].recorded_here || own;
    }
    if (!own && all_records) shards_.push_back(file);
    // What is appended begins on a line of its own.
    if (own && !text.empty() && !text.ends_with('\n')) append("\n", false);
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

std::optional<FinishedJob> GalleryRecord::finished(const std::string& file, const std::string& hash) const {
    const auto found = known_.find(file);
    if (found == known_.end()) return std::nullopt;
    const std::vector<FinishedJob>& versions = found->second.versions;
    const auto same = std::find_if(versions.begin(), versions.end(),
                                   [&](const FinishedJob& version) { return version.hash == hash; });
    if (same == versions.end()) return std::nullopt;
    struct stat status {};
    const std::filesystem::path path = folder_ / file;
    if (::stat(path.c_str(), &status) != 0 || !S_ISREG(status.st_mode) ||
        static_cast<std::uint64_t>(status.st_size) != same->bytes) {
        return std::nullopt;
    }
    const bool agree = std::all_of(versions.begin(), versions.end(),
                                   [&](const FinishedJob& version) { return version.hash == hash; });
    // A claim after the last record may have made it anew, from another pattern.
    if ((!agree || found->second.claimed) && content_hash(path) != same->content) return std::nullopt;
    return *same;
}

std::optional<FinishedJob> GalleryRecord::last(const std::string& file) const {
    const auto found = known_.find(file);
    if (found == known_.end() || found->second.versions.empty()) return std::nullopt;
    return found->second.versions.back();
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
    nlohmann::json json;
    json["claim"] = file;
    append(json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n", false);
}

void GalleryRecord::add(const FinishedJob& job) {
    append(job.line(), true);
}

void GalleryRecord::complete(const std::vector<FinishedJob>& order, bool sole) {
    std::string text;
    std::set<std::string> written;
    for (const FinishedJob& job : order) {
        text += job.line();
        written.insert(job.file);
    }
    // Of other jobs, what is still there.
    for (const auto& [file, known] : known_) {
        if (written.contains(file) || known.versions.empty() || !(known.recorded_here || sole)) continue;
        const FinishedJob& job = known.versions.back();
        std::error_code error;
        if (std::filesystem::file_size(folder_ / file, error) == job.bytes && !error) text += job.line();
    }
    const std::filesystem::path file = folder_ / name_;
    OutputFile output(file);
    output.write(text);
    synchronise(output.temporary());
    output.commit();
    synchronise(folder_);
    if (!sole) return;
    for (const auto& shard : shards_) {
        const int descriptor = ::open(shard.c_str(), O_RDONLY | O_CLOEXEC);
        if (descriptor < 0) continue;
        if (::flock(descriptor, LOCK_EX | LOCK_NB) == 0) ::unlink(shard.c_str());
        ::close(descriptor);
    }
}

}  // namespace sikku
