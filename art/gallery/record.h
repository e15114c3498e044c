// art/gallery/record.h: the record of a gallery's folder: one line of JSON for each finished job.
#pragma once

#include "art/gallery/job_result.h"
#include "art/gallery/locks.h"

#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace sikku {

struct RecordText;

/// The records of a folder. Each run appends to one file, `gallery.jsonl` or that of its shard, and reads all of
/// them, again whenever other runs are active. Before a file is made, it is locked against all other runs and its
/// name is claimed in the record, so that the unfinished files of a killed run are recognised as the gallery's own.
/// Incomplete lines, such as the last line of a killed run, are ignored. May be used from several threads.
class GalleryRecord {
public:
    /// Locks the record against other runs of the same shard and removes the unfinished files of killed runs.
    /// @param name      name of this run's file in the folder
    /// @param replaces  replace a file of that name not made by a gallery, which is an error otherwise
    /// @param waiting   called ten times a second while another run of the same shard is active; may throw to give up
    /// @throws std::runtime_error if the folder or the record cannot be written, or if it is a link
    GalleryRecord(const GalleryFolder& folder, std::string name, bool replaces, const std::function<void()>& waiting);
    GalleryRecord(const GalleryRecord&) = delete;
    GalleryRecord& operator=(const GalleryRecord&) = delete;

    /// The record of a file that is unchanged, regardless of its settings. Its size decides whether it is unchanged;
    /// the file is read only if records contradict each other or its name was claimed again.
    std::optional<FinishedJob> present(const std::string& file) const;
    /// The same, if the file was made from settings with that hash.
    std::optional<FinishedJob> finished(const std::string& file, const std::string& hash) const;
    /// True if a file of this name was made or begun by a gallery.
    bool is_ours(const std::string& file) const;
    /// True if the file was begun but not finished, by an ended or an active run.
    bool is_begun(const std::string& file) const;

    /// Reserves the file for this run; false if another run is making it.
    bool take(const std::string& file) { return locks_.take(file); }
    void release(const std::string& file) { locks_.release(file); }
    /// Reads what other runs have recorded since the last call. Without other runs it costs two system calls.
    void refresh();

    /// Call before `file` appears, after take().
    void claim(const std::string& file);
    /// Synchronises the claims. Call before files appear: after a system crash, an existing file without a
    /// claim would be refused.
    void synchronise();
    /// Appends the records of files that are on the disk in a single write, and synchronises it.
    void add(std::span<const FinishedJob* const> jobs);
    /// Rewrites the record beside the old one and renames it into place: the finished jobs of `order`, in that order,
    /// then all other made or begun files. As `sole`, it merges the current records of shards, including the
    /// unfinished files of killed ones, and removes those records unless they are in use. A shard record that adds
    /// nothing to `gallery.jsonl` is removed. Do not add records afterwards.
    /// @param begun  files that this run began and did not finish; the next run makes others first
    void complete(const std::vector<FinishedJob>& order, const std::vector<std::string>& begun, bool sole);

private:
    struct Known {
        std::vector<FinishedJob> versions;  ///< different ones found in the records
        bool claimed = false;               ///< claimed after the last record, in one of the records
        bool kept = false;                  ///< it belongs in the record of this run
    };
    /// Read position in the record of another run.
    struct Reading {
        ino_t inode = 0;
        off_t bytes = 0;
        std::string end;  ///< last bytes of the part read: inode numbers are reused
    };
    /// The record of a shard that no run is using, locked.
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
    void append(const std::string& text);
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
    std::set<std::string> left_;  ///< files of which killed runs may have left unfinished parts
    mutable std::mutex mutex_;
};

}  // namespace sikku
