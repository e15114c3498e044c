#include "engine/base/output_file.h"

#include "engine/base/characters.h"
#include "engine/base/child_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <map>
#include <new>
#include <set>
#include <span>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>

namespace sikku {

/// An entry of the list that remove_unfinished_files() reads. Entries are only ever added, so that a signal handler
/// can walk the list at any time; those of completed files are reused. There are as many as the maximum number of
/// files open at once.
struct UnfinishedFile {
    std::atomic<const char*> path{nullptr};
    UnfinishedFile* next = nullptr;  // never changes once the entry is in the list
};

namespace {

std::atomic<UnfinishedFile*> unfinished{nullptr};
/// True once a signal handler reads the paths, which are not freed from then on. Never reset, because another handler
/// may still be reading when the first one is done.
std::atomic<bool> is_removing{false};
static_assert(std::atomic<UnfinishedFile*>::is_always_lock_free && std::atomic<bool>::is_always_lock_free,
              "a signal handler must not wait for a lock");

UnfinishedFile* remember(const std::filesystem::path& path) {
    const char* copy = ::strdup(path.c_str());
    if (!copy) throw std::bad_alloc();
    for (UnfinishedFile* entry = unfinished.load(); entry; entry = entry->next) {
        const char* free_path = nullptr;
        if (entry->path.compare_exchange_strong(free_path, copy)) return entry;
    }
    auto* entry = new (std::nothrow) UnfinishedFile;
    if (!entry) {
        std::free(const_cast<char*>(copy));
        throw std::bad_alloc();
    }
    entry->path = copy;
    entry->next = unfinished.load();
    while (!unfinished.compare_exchange_weak(entry->next, entry)) {
    }
    return entry;
}

void forget(UnfinishedFile* entry) {
    if (!entry) return;
    const char* path = entry->path.exchange(nullptr);
    // A handler that has read it set is_removing before.
    if (!is_removing) std::free(const_cast<char*>(path));
}

constexpr std::size_t buffer_bytes = std::size_t{1} << 20;
constexpr std::size_t longest_stem = 200;  // of a temporary name, so that it stays below the 255 of file systems
constexpr int most_links = 40;             // limit of the kernel

/// True for errors of a synchronising call that mean that the file system or the kind of file does not support it.
bool is_not_for_sync(int error) {
    return error == EINVAL || error == EROFS || error == ENOTSUP || error == ENOSYS;
}

/// Calls fsync() or syncfs() and returns the error number, 0 on success.
int synchronise(int descriptor, int (*call)(int) = ::fsync) {
    while (call(descriptor) != 0) {
        if (errno != EINTR) return is_not_for_sync(errno) ? 0 : errno;
    }
    return 0;
}

Descriptor open_folder(const std::filesystem::path& folder) {
    return Descriptor(::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC | O_NONBLOCK));
}

/// Synchronises the names in a folder, unless it cannot be opened.
int synchronise_folder(const std::filesystem::path& folder) {
    const Descriptor descriptor = open_folder(folder);
    return descriptor ? synchronise(descriptor.get()) : 0;
}

/// Synchronises all files of the file system that a folder is on.
int synchronise_file_system(const Descriptor& folder) {
#ifdef __EMSCRIPTEN__
    return synchronise(folder.get(), ::fsync);
#else
    return synchronise(folder.get(), ::syncfs);
#endif
}

/// The descriptor that a name such as /dev/stdout or /dev/fd/3 stands for. Opening it by name would begin at the
/// first byte of a redirected file instead of where the shell is.
std::optional<int> named_descriptor(const std::string& name) {
    if (name == "/dev/stdout") return STDOUT_FILENO;
    if (name == "/dev/stderr") return STDERR_FILENO;
    for (const std::string_view folder : {"/dev/fd/", "/proc/self/fd/"}) {
        if (!name.starts_with(folder)) continue;
        const char* begin = name.data() + folder.size();
        const char* end = name.data() + name.size();
        int descriptor = 0;
        const auto [stop, error] = std::from_chars(begin, end, descriptor);
        if (error == std::errc() && stop == end && descriptor >= 0) return descriptor;
    }
    return std::nullopt;
}

/// `/proc/PID/fd/N/NAME`: a name in a folder that is held open.
bool is_in_held_folder(const std::string& name) {
    std::string_view rest = name;
    const auto take = [&](std::string_view piece) {
        if (!rest.starts_with(piece)) return false;
        rest.remove_prefix(piece.size());
        return true;
    };
    const auto take_number = [&] {
        const std::size_t digits = std::min(rest.find_first_not_of("0123456789"), rest.size());
        rest.remove_prefix(digits);
        return digits > 0;
    };
    return take("/proc/") && take_number() && take("/fd/") && take_number() && take("/") && !rest.empty() &&
           rest.find('/') == std::string_view::npos;
}

std::string random_letters() {
    constexpr std::string_view letters = "abcdefghijklmnopqrstuvwxyz234567";
    std::array<unsigned char, 6> bytes{};
    if (::getentropy(bytes.data(), bytes.size()) != 0) bytes.fill(0);
    std::string result;
    for (const unsigned char byte : bytes) result += letters[byte % letters.size()];
    return result;
}

/// Returns the name, shortened to fit into a temporary name, at a character boundary.
std::string stem_of(const std::filesystem::path& target) {
    std::string stem = target.filename().string();
    if (stem.size() > longest_stem) {
        std::size_t end = longest_stem;
        while (end > 0 && is_continuation(stem[end])) --end;
        stem.resize(end);
    }
    return stem;
}

}  // namespace

OutputFile::OutputFile(std::filesystem::path target, std::filesystem::path shown)
    : name_(std::move(target)), shown_(shown.empty() ? name_ : std::move(shown)), target_(name_) {
    buffer_.reserve(buffer_bytes);
    if (const auto named = named_descriptor(name_.string())) {
        direct_ = true;
        temporary_ = target_;
        descriptor_ = ::fcntl(*named, F_DUPFD_CLOEXEC, 3);
        if (descriptor_ < 0) fail(errno);
        return;
    }
    const bool is_held = is_in_held_folder(name_.string());
    for (int links = 0;; ++links) {
        struct stat status {};
        if (::lstat(target_.c_str(), &status) != 0) {
            if (errno != ENOENT) fail(errno);
            if (target_.filename().empty()) fail(target_.empty() ? ENOENT : EISDIR);
            break;
        }
        // A caller that holds a folder open does not trust its contents: links are replaced, not followed.
        if (is_held && !S_ISREG(status.st_mode) && !S_ISDIR(status.st_mode)) break;
        if (S_ISLNK(status.st_mode)) {
            if (links == most_links) fail(ELOOP);
            std::error_code error;
            const std::filesystem::path pointee = std::filesystem::read_symlink(target_, error);
            if (error) fail(error.value());
            target_ = target_.parent_path() / pointee;
            continue;
        }
        if (S_ISDIR(status.st_mode)) fail(EISDIR);
        direct_ = !S_ISREG(status.st_mode);
        mode_ = static_cast<int>(status.st_mode & 0777);
        // A rename would bypass the protection of a read-only file.
        if (::faccessat(AT_FDCWD, target_.c_str(), W_OK, AT_EACCESS) != 0) fail(errno);
        break;
    }
    create();
}

void OutputFile::create() {
    if (direct_) {
        temporary_ = target_;
        descriptor_ = ::open(target_.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY);
        if (descriptor_ < 0) fail(errno);
        return;
    }
    const std::string stem = stem_of(target_);
    // Never more permissions than the file it replaces, but enough for programs that open temporary().
    const mode_t mode = mode_ < 0 ? 0666 : static_cast<mode_t>(mode_) | 0600;
    for (int attempt = 0;; ++attempt) {
        temporary_ = target_.parent_path() / fmt::format(".{}.{}.tmp", stem, random_letters());
        // Remembered before it exists, because a signal may come at any time.
        entry_ = remember(temporary_);
        descriptor_ = ::open(temporary_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, mode);
        if (descriptor_ >= 0) return;
        const int error = errno;
        forget(std::exchange(entry_, nullptr));
        if (error != EEXIST || attempt == 100) fail(error);
    }
}

OutputFile::~OutputFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
    if (!direct_ && !temporary_.empty()) ::unlink(temporary_.c_str());
    forget(entry_);
}

void OutputFile::write(std::string_view bytes) {
    written_ += bytes.size();
    if (buffer_.size() + bytes.size() <= buffer_bytes) {
        buffer_.append(bytes);
        return;
    }
    flush();
    if (bytes.size() >= buffer_bytes) {
        put(bytes);
    } else {
        buffer_.append(bytes);
    }
}

void OutputFile::flush() {
    put(buffer_);
    buffer_.clear();
}

/// Writes bytes at an offset, or where the last ones end.
void OutputFile::put(std::string_view bytes, std::optional<std::uint64_t> offset) {
    while (!bytes.empty()) {
        const ssize_t done = offset ? ::pwrite(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(*offset))
                                    : ::write(descriptor_, bytes.data(), bytes.size());
        if (done < 0) {
            if (errno == EINTR) continue;
            fail(errno);
        }
        bytes.remove_prefix(static_cast<std::size_t>(done));
        if (offset) *offset += static_cast<std::uint64_t>(done);
    }
}

void OutputFile::overwrite(std::uint64_t position, std::string_view bytes) {
    if (direct_ || position + bytes.size() > written_) throw std::logic_error("OutputFile::overwrite: no such place");
    flush();
    put(bytes, position);
}

void OutputFile::insert(std::uint64_t position, std::string_view bytes) {
    if (direct_ || position > written_) throw std::logic_error("OutputFile::insert: no such place");
    if (bytes.empty()) return;
    flush();
    // From the end, so that nothing is overwritten before it is read.
    std::string block;
    for (std::uint64_t end = written_; end > position;) {
        const std::uint64_t begin = end - std::min<std::uint64_t>(end - position, buffer_bytes);
        block.resize(static_cast<std::size_t>(end - begin));
        std::size_t read = 0;
        while (read < block.size()) {
            const ssize_t done =
                ::pread(descriptor_, block.data() + read, block.size() - read, static_cast<off_t>(begin + read));
            if (done < 0 && errno == EINTR) continue;
            if (done <= 0) fail(done < 0 ? errno : EIO);
            read += static_cast<std::size_t>(done);
        }
        put(block, begin + bytes.size());
        end = begin;
    }
    put(bytes, position);
    written_ += bytes.size();
    if (::lseek(descriptor_, 0, SEEK_END) < 0) fail(errno);
}

const std::filesystem::path& OutputFile::temporary() {
    flush();
    return temporary_;
}

void OutputFile::commit() {
    finish(true);
    if (direct_) return;
    publish();
    if (const int error = synchronise_folder(target_.parent_path()); error != 0) fail(error);
}

/// Writes the rest of the buffer and closes the file.
void OutputFile::finish(bool synchronised) {
    flush();
    std::string().swap(buffer_);  // frees the memory
    if (!direct_) {
        // Synchronise by name, because a library may have recreated the file.
        struct stat own {};
        struct stat named {};
        const bool is_own = ::fstat(descriptor_, &own) == 0 && ::lstat(temporary_.c_str(), &named) == 0 &&
                            own.st_ino == named.st_ino && own.st_dev == named.st_dev;
        const int whole =
            is_own ? descriptor_ : ::open(temporary_.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
        if (whole < 0) fail(errno);
        int error = mode_ >= 0 && ::fchmod(whole, static_cast<mode_t>(mode_)) != 0 ? errno : 0;
        if (error == 0 && synchronised) error = sikku::synchronise(whole);
        if (!is_own) ::close(whole);
        if (error != 0) fail(error);
    }
    const int descriptor = std::exchange(descriptor_, -1);
    // Some file systems report a full disk only here.
    if (::close(descriptor) != 0 && errno != EINTR) fail(errno);
}

/// Renames the closed file into place.
void OutputFile::publish() {
    if (::rename(temporary_.c_str(), target_.c_str()) != 0) fail(errno);
    temporary_.clear();
    forget(std::exchange(entry_, nullptr));
}

/// Synchronises a closed file.
void OutputFile::synchronise() const {
    const Descriptor file(::open(temporary_.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK));
    if (const int error = file ? sikku::synchronise(file.get()) : errno; error != 0) fail(error);
}

struct OutputFiles::Group {
    /// A folder, held open since before its files are written, so that their errors are reported to it.
    struct Folder {
        Descriptor descriptor;  ///< none if it is unreadable
        dev_t device = 0;
        ino_t inode = 0;
        std::uint64_t number = 0;  ///< in the order in which folders were opened
    };
    /// An output that becomes a part of the group.
    struct Member final : Output {
        Member(Group& owner, const std::filesystem::path& target)
            : group(owner), file(std::make_unique<OutputFile>(target)) {
            if (file->direct_) return;
            if (const int error = group.hold_folder(file->target_.parent_path()); error != 0) file->fail(error);
        }
        void write(std::string_view bytes) override { file->write(bytes); }
        std::uint64_t size() const override { return file->size(); }
        bool can_insert() const override { return file->can_insert(); }
        void insert(std::uint64_t position, std::string_view bytes) override { file->insert(position, bytes); }
        void overwrite(std::uint64_t position, std::string_view bytes) override { file->overwrite(position, bytes); }
        const std::filesystem::path& temporary() override { return file->temporary(); }
        void commit() override {
            file->finish(false);
            group.files.push_back(std::move(file));
        }

        Group& group;
        std::unique_ptr<OutputFile> file;
    };

    /// Returns the error number, 0 on success. An unreadable folder is not an error.
    int hold_folder(const std::filesystem::path& path) {
        if (folders.contains(path)) return 0;
        Folder folder{open_folder(path)};
        if (!folder.descriptor && errno != EACCES) return errno;
        if (folder.descriptor) {
            // After opening: the lowest number of several folders was opened before files of any were written.
            static std::atomic<std::uint64_t> opened{0};
            folder.number = ++opened;
            struct stat status {};
            if (::fstat(folder.descriptor.get(), &status) != 0) return errno;
            folder.device = status.st_dev;
            folder.inode = status.st_ino;
        }
        folders.emplace(path, std::move(folder));
        return 0;
    }
    const Folder& folder_of(const OutputFile& file) const { return folders.at(file.target_.parent_path()); }
    std::map<std::filesystem::path, Folder> folders;
    std::vector<std::unique_ptr<OutputFile>> files;
};

OutputFiles::OutputFiles() : group_(std::make_unique<Group>()) {}
OutputFiles::~OutputFiles() = default;
OutputFiles::OutputFiles(OutputFiles&&) noexcept = default;
OutputFiles& OutputFiles::operator=(OutputFiles&&) noexcept = default;

std::unique_ptr<Output> OutputFiles::open(const std::filesystem::path& target) {
    return std::make_unique<Group::Member>(*group_, target);
}

void OutputFiles::add(const std::filesystem::path& target, std::string_view bytes) {
    const std::unique_ptr<Output> file = open(target);
    file->write(bytes);
    file->commit();
}

std::filesystem::path OutputFiles::temporary(const std::filesystem::path& target) const {
    for (const auto& file : group_->files) {
        if (file->name_ == target) return file->temporary_;
    }
    return {};
}

void OutputFiles::commit() {
    OutputFiles* const self = this;
    commit(std::span(&self, 1));
}

void OutputFiles::commit(std::span<OutputFiles* const> groups) {
    // Files that have not appeared.
    std::vector<std::pair<OutputFile*, const Group::Folder*>> files;
    // The folders of all files: if an earlier call failed, those of files that have appeared are not synchronised
    // yet. Several paths may name one folder.
    std::map<std::pair<dev_t, ino_t>, std::pair<const OutputFile*, const Group::Folder*>> folders;
    // The folder of each device that was opened first: only its descriptor reports all errors of the files.
    std::map<dev_t, const Group::Folder*> oldest;
    for (const OutputFiles* each : groups) {
        for (const auto& file : each->group_->files) {
            if (file->direct_) continue;
            const Group::Folder& folder = each->group_->folder_of(*file);
            if (!file->temporary_.empty()) files.emplace_back(file.get(), &folder);
            if (!folder.descriptor) continue;
            folders.try_emplace({folder.device, folder.inode}, file.get(), &folder);
            const Group::Folder*& first = oldest[folder.device];
            if (!first || folder.number < first->number) first = &folder;
        }
    }
    // Each file takes a few milliseconds, and the whole file system not much more.
    constexpr std::size_t few = 3;
    std::set<dev_t> devices;
    for (const auto& [file, folder] : files) {
        if (files.size() <= few || !folder->descriptor) {
            file->synchronise();
        } else if (devices.insert(folder->device).second) {
            const Descriptor& descriptor = oldest.at(folder->device)->descriptor;
            if (const int error = synchronise_file_system(descriptor); error != 0) file->fail(error);
        }
    }
    for (const auto& each : files) each.first->publish();
    for (const auto& each : folders) {
        const auto& [file, folder] = each.second;
        if (const int error = synchronise(folder->descriptor.get()); error != 0) file->fail(error);
    }
}

void OutputFile::fail(int error) const {
    cannot_write(shown_, error);
}

void cannot_write(const std::filesystem::path& file, int error) {
    std::string cause = std::generic_category().message(error);
    std::error_code unknown;
    const std::filesystem::path folder = file.parent_path();
    if (error == ENOENT && !folder.empty() && !std::filesystem::exists(folder, unknown)) {
        cause = fmt::format("the folder '{}' does not exist", folder.string());
    }
    throw std::runtime_error(fmt::format("cannot write '{}': {}", file.string(), cause));
}

void remove_unfinished_files() noexcept {
    is_removing = true;
    // Twice, for files that another thread was opening meanwhile.
    for (int pass = 0; pass < 2; ++pass) {
        for (UnfinishedFile* entry = unfinished.load(); entry; entry = entry->next) {
            if (const char* path = entry->path.load()) ::unlink(path);
        }
    }
}

std::filesystem::path temporary_folder() {
    std::error_code error;
    std::filesystem::path folder = std::filesystem::temp_directory_path(error);
    if (!error) return folder;
    std::string where;
    for (const char* name : {"TMPDIR", "TMP", "TEMP", "TEMPDIR"}) {
        const char* chosen = std::getenv(name);
        if (chosen && where.empty()) where = " (" + std::string(name) + " is '" + chosen + "')";
    }
    throw std::runtime_error("the folder for temporary files cannot be used" + where + ": " + error.message());
}

}  // namespace sikku
