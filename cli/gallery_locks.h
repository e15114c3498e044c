// cli/gallery_locks.h: which file of a gallery a run is making just now, seen by all runs in the folder.
#pragma once

#include "cli/gallery_folder.h"

#include <cstdint>
#include <string>

namespace sikku {

/// Locks of the runs that are at work in a folder, whole ones, shards and restarts alike. They are locks on bytes of
/// the file `.gallery.lock` (a line in it for each run: host and process), which the last run removes. The system
/// drops the locks of a process that ends, however it ends; so a file whose lock is free has no living owner, and
/// what is left unfinished of it may be removed. Network file systems pass the locks on to other hosts; where there
/// are no locks at all nothing is known of other runs.
class GalleryLocks {
public:
    /// @throws std::runtime_error if the file cannot be written or is not what it should be
    explicit GalleryLocks(const GalleryFolder& folder);
    ~GalleryLocks();
    GalleryLocks(const GalleryLocks&) = delete;
    GalleryLocks& operator=(const GalleryLocks&) = delete;

    /// Does the file system have locks?
    bool work() const { return static_cast<bool>(file_); }
    /// Locks a file of the gallery; false if another run has it. Without locks, always true.
    bool take(const std::string& file);
    void release(const std::string& file);

    /// Is another run at work? Without locks that is not known, and true.
    bool others_present() const;
    /// Grows when a run begins. Without locks, with each call.
    std::uint64_t arrivals();

    /// While it lives no other run writes records anew, and, if it is exclusive, none reads them either. Waits for
    /// its turn. One at a time in a process.
    class Turn {
    public:
        Turn(GalleryLocks& locks, bool exclusive);
        ~Turn();
        Turn(const Turn&) = delete;
        Turn& operator=(const Turn&) = delete;

    private:
        GalleryLocks& locks_;
    };

private:
    enum class Result { locked, busy, unsupported };
    Result lock(short type, std::int64_t byte, bool waits) const;
    bool is_named() const;

    const GalleryFolder& folder_;
    Descriptor file_;
    std::uint64_t calls_ = 0;
};

}  // namespace sikku
