// art/gallery/locks.h: locks that show all runs in a folder which gallery files are being made.
#pragma once

#include "art/gallery/folder.h"

#include <cstdint>
#include <string>

namespace sikku {

/// Locks of the runs working in a folder: whole runs, shards and restarts alike. They lock bytes of the file
/// `.gallery.lock` (one line per run: host and process), which the last run removes. The system drops the locks of a
/// process however it ends, so a file whose lock is free does not have a living owner, and its unfinished parts may
/// be removed. Network file systems pass the locks on to other hosts; without lock support, other runs cannot be
/// detected. Support for locks is determined once, at the start. A lock that fails later, as when a server lacks
/// memory for more locks, ends the run with an error: without the lock, another run could remove the unfinished file
/// as that of a dead owner. Finished files stay, and the run can be started again.
class GalleryLocks {
public:
    /// @throws std::runtime_error if the file cannot be written or has the wrong type or contents
    explicit GalleryLocks(const GalleryFolder& folder);
    ~GalleryLocks();
    GalleryLocks(const GalleryLocks&) = delete;
    GalleryLocks& operator=(const GalleryLocks&) = delete;

    /// True if the file system supports locks.
    bool work() const { return static_cast<bool>(file_); }
    /// Locks a file of the gallery; false if another run holds the lock. Without lock support, always true.
    /// @throws std::runtime_error if locks are supported and this one fails
    bool take(const std::string& file);
    void release(const std::string& file);

    /// True if another run is active, or if locks are not supported.
    bool others_present() const;
    /// Counter that grows when a run begins; without locks, with each call.
    std::uint64_t arrivals();

    /// Holds the lock of the records: no other run rewrites them and, if it is exclusive, none reads them. The
    /// constructor waits for the lock. At most one at a time in a process.
    class Turn {
    public:
        /// @throws std::runtime_error if locks are supported and this one fails
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
    Result require_lock(short type, std::int64_t byte, bool waits) const;
    bool is_named() const;

    const GalleryFolder& folder_;
    Descriptor file_;
    std::uint64_t calls_ = 0;
};

}  // namespace sikku
