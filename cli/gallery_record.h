// cli/gallery_record.h: what a gallery's folder is known to hold: one line of JSON for each finished job.
#pragma once

#include "cli/gallery_locks.h"

#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace sikku {

/// What is known of a file that was made. Nothing in it depends on when or how fast it was made.
struct FinishedJob {
    std::string file;               ///< path below the folder
    std::string hash;               ///< GalleryJob::hash()
    std::uint64_t bytes = 0;        ///< of the file
    std::string content;            ///< hash of the file's bytes
    std::string job;                ///< GalleryJob::text()
    std::vector<std::string> told;  ///< what there was to tell, warnings first of all

    /// One line of JSON, with its line feed.
    std::string line() const;
};

struct RecordText;

/// The records of a folder. Each run appends to one file, `gallery.jsonl` or that of its shard, and reads those of
/// all, anew where others are at work at the same time. Before a file is made it is locked against all other runs and
/// its name is claimed in the record, so that what a killed run leaves is known as the gallery's own. Lines that are
/// torn, as the last of a killed run may be, count for nothing. May be used from several threads.
class GalleryRecord {
public:
    /// Locks the record against other runs of the same shard and removes what a killed run left unfinished.
    /// @param name      of the file of this run, in the folder
    /// @param replaces  also a file of that name that others made, which is an error otherwise
    /// @param waiting   called ten times a second while another run of the same shard is at work; may throw to give
    /// up
    /// @throws std::runtime_error if the folder or the record cannot be written, or if it is a link
    GalleryRecord(const GalleryFolder& folder, std::string name, bool replaces, const std::function<void()>& waiting);
    GalleryRecord(const GalleryRecord&) = delete;
    GalleryRecord& operator=(const GalleryRecord&) = delete;

    /// The record of a file that is there as it was made, whatever it was made from. That it is as it was made its
    /// size tells; it is read only where records contradict each other.
    std::optional<FinishedJob> present(const std::string& file) const;
    /// The same, if it was made from what has that hash.
    std::optional<FinishedJob> finished(const std::string& file, const std::string& hash) const;
    /// Was a file of this name made or begun by a gallery?
    bool is_ours(const std::string& file) const;
    /// Was it begun and not finished, by a run that ended or by one that is at work?
    bool is_begun(const std::string& file) const;

    /// Keeps all other runs from making the file; false if one of them makes it.
    bool take(const std::string& file) { return locks_.take(file); }
    void release(const std::string& file) { locks_.release(file); }
    /// Reads what other runs recorded since the last time, if there were any. Where none were, two system calls.
    void refresh();

    /// To be called before `file` appears, after take().
    void claim(const std::string& file);
    /// Sees the file on the disk, then appends the record in a single write, and sees it there, too.
    void add(const FinishedJob& job);
    /// Writes the record anew, beside it and then in its place: the jobs of `order` that are finished, in that order,
    /// then what else is there that was made or begun. As `sole`, it takes over the records of shards as they are by
    /// then, with what killed ones left unfinished, and removes them, unless they are in use. The record of a shard
    /// that says nothing but what `gallery.jsonl` says as well is removed. Nothing may be added after that.
    /// @param begun  files that this run began and did not finish, so that the next one makes others first
    void complete(const std::vector<FinishedJob>& order, const std::vector<std::string>& begun, bool sole);

private:
    struct Known {
        std::vector<FinishedJob> versions;  ///< different ones, as the records have them
        bool claimed = false;               ///< after the last record, in one of them
        bool kept = false;                  ///< it belongs into the record of this run
    };
    /// How far the record of another run was read.
    struct Reading {
        ino_t inode = 0;
        off_t bytes = 0;
        std::string end;  ///< of what was read: numbers of files are used again
    };
    /// The record of a shard that no run is at work on, locked.
    struct Left {
        std::string name;
        Descriptor descriptor;
    };
    std::optional<FinishedJob> present(const std::string& file, const Known& known) const;
    Descriptor open(const std::function<void()>& waiting) const;
    std::vector<std::string> others() const;
    static bool continues(const Descriptor& record, const Reading& reading);
    void read_others();
    void take_in(const RecordText& record, bool keeps);
    std::vector<Left> take_over_shards();
    bool is_in_the_whole(const std::vector<FinishedJob>& jobs) const;
    void append(const std::string& line, bool durable);
    void remove_left();
    void replace(const std::string& text) const;

    const GalleryFolder& folder_;
    std::string name_;
    Descriptor descriptor_;
    GalleryLocks locks_;
    std::uint64_t arrivals_ = 0;
    bool others_were_present_ = true;
    std::map<std::string, Reading> others_;
    std::map<std::string, Known> known_;
    std::set<std::string> left_;  ///< begun by killed runs; what is unfinished of them may lie there
    mutable std::mutex mutex_;
};

}  // namespace sikku
