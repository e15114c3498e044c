// art/gallery/publisher.h: makes files of a gallery, which appear together and are then recorded.
#pragma once

#include "art/gallery/folder.h"
#include "art/gallery/job_result.h"
#include "art/gallery/record.h"
#include "engine/base/monitor.h"
#include "engine/base/output_file.h"

#include <condition_variable>
#include <cstddef>
#include <exception>
#include <filesystem>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace sikku {

/// A complete file of a gallery that still lacks its final name and its record.
struct MadeFile {
    FinishedJob file;
    GalleryPlace place;
    OutputFiles outputs;
};

/// Makes a file at a path in a destination and adds its messages to `file`.
using FileMaker = std::function<void(const std::filesystem::path& path, Destination& destination, FinishedJob& file)>;

/// Makes a file of the gallery. The caller must ensure that no other run makes it at the same time.
/// @param file  with `file`, `hash` and `job` set
/// @param replaces  replace an existing file even if it was not made by this gallery; otherwise it causes a
///                  std::runtime_error. Anything that is neither a file nor a folder, such as a link, is removed
///                  first
/// @throws exceptions of `make`; other errors than Stopped as std::runtime_error
MadeFile make_gallery_file(GalleryRecord& record, const GalleryFolder& folder, FinishedJob file, bool replaces,
                           const FileMaker& make);

/// Synchronises files, renames them and records them. A file that cannot be recorded is removed: the next run would
/// refuse it. @throws std::runtime_error
void publish_gallery_file(GalleryRecord& record, MadeFile& made);

/// Publishes files on a thread of its own, so that no job waits for the disk. Files that are finished meanwhile are
/// published together: one synchronisation makes as many files durable as the jobs finish during the one before. A
/// killed run loses these files: at most most_waiting() that wait, as many that are being published, and one of each
/// thread that adds files; they are made again. After a crash of the machine, files that appeared and their records
/// are whole.
class Publisher {
public:
    /// 100, or fewer if the process may open few files: each holds two folders open.
    static std::size_t most_waiting();
    /// Receives the file and the reason why it could not be published; empty if it was. Must not throw.
    using Done = std::function<void(FinishedJob file, std::string problem)>;

    explicit Publisher(GalleryRecord& record);
    /// Publishes the files that wait.
    ~Publisher();
    Publisher(const Publisher&) = delete;
    Publisher& operator=(const Publisher&) = delete;

    /// Waits while many files are waiting. `done` is called from another thread. @throws the error that ended the
    /// thread, and std::bad_alloc; the file is then removed, and `done` is not called
    void add(MadeFile file, Done done);
    /// Publishes the files that wait, and ends the thread. Add no files afterwards. @throws the error that
    /// ended the thread before; files that waited are then removed
    void finish();

private:
    struct Waiting {
        MadeFile made;
        Done done;
    };
    void work() noexcept;
    void publish_all();
    void end();
    void publish(std::vector<Waiting> group);

    GalleryRecord& record_;
    std::mutex mutex_;
    std::condition_variable changed_;
    std::vector<Waiting> waiting_;
    const std::size_t most_waiting_ = most_waiting();
    bool ends_ = false;
    std::exception_ptr error_;  ///< ended the thread
    std::thread thread_;        ///< none if it could not be started
};

}  // namespace sikku
