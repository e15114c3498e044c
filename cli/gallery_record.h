// cli/gallery_record.h: what a gallery's folder is known to hold: one line of JSON for each finished job.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
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

/// Hash of a file's bytes; empty if it cannot be read.
std::string content_hash(const std::filesystem::path& file);

struct RecordText;

/// The records of a folder. Each run appends to one file, `gallery.jsonl` or that of its shard, and reads those of
/// all. Before a file is made its name is claimed there, so that what a killed run leaves is known as its own. Lines
/// that are torn, as the last of a killed run may be, count for nothing. May be used from several threads.
class GalleryRecord {
public:
    /// Makes the folder, locks the record against other runs of the same shard and removes what a killed run left
    /// unfinished.
    /// @param name      of the file of this run, in the folder
    /// @param replaces  also a file of that name that others made, which is an error otherwise
    /// @throws std::runtime_error if the folder or the record cannot be written, or if another run is at work
    GalleryRecord(std::filesystem::path folder, std::string name, bool replaces);
    ~GalleryRecord();
    GalleryRecord(const GalleryRecord&) = delete;
    GalleryRecord& operator=(const GalleryRecord&) = delete;

    /// The record of a file that is there as it was made, whatever it was made from. That it is as it was made its
    /// size tells; it is read only where records contradict each other.
    std::optional<FinishedJob> present(const std::string& file) const;
    /// The same, if it was made from what has that hash.
    std::optional<FinishedJob> finished(const std::string& file, const std::string& hash) const;
    /// Was a file of this name made or begun by a gallery?
    bool is_ours(const std::string& file) const;

    /// To be called before `file` appears.
    void claim(const std::string& file);
    /// Sees the file on the disk, then appends the record in a single write, and sees it there, too.
    void add(const FinishedJob& job);
    /// Writes the record anew, beside it and then in its place: the jobs of `order` that are finished, in that order,
    /// then what else is there that was made or begun. As `sole`, it takes over the records of shards as they are by
    /// then, with what killed ones left unfinished, and removes them, unless they are in use.
    void complete(const std::vector<FinishedJob>& order, bool sole);

private:
    struct Known {
        std::vector<FinishedJob> versions;  ///< one for each record file that has one
        bool claimed = false;               ///< after the last record, in one of them
        bool kept = false;                  ///< it belongs into the record of this run
    };
    std::vector<std::filesystem::path> others() const;
    void take(const RecordText& record, bool keeps);
    void open();
    void append(const std::string& line, bool durable);
    void remove_unfinished(const std::string& file) const;

    std::filesystem::path folder_;
    std::string name_;
    int descriptor_ = -1;
    std::map<std::string, Known> known_;
    std::mutex mutex_;
};

}  // namespace sikku
