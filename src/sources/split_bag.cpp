#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "sources/bag_file.hpp"

namespace saccade {
namespace {

// The upper bits of a place say in which file it is, the lower ones where in it.
constexpr unsigned kPartBits = 48;
constexpr std::uint64_t kPartMask = (std::uint64_t{1} << kPartBits) - 1;

// Several files as one; topics of one name and type are one topic.
class SplitBag final : public BagFile {
 public:
  explicit SplitBag(std::vector<BagPart> parts) : parts_(std::move(parts)) {}

  void scan(const Visit& visit) override {
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      BagFile& file = *parts_[i].file;
      std::vector<std::size_t> numbers;  // of its topics, among all
      file.scan([&](std::size_t topic, std::int64_t time_ns, Bytes beginning, const BagPlace& place) {
        while (numbers.size() < file.topics().size())
          numbers.push_back(number_of(file.topics()[numbers.size()]));
        BagPlace here = place;
        here.part = std::uint64_t{i} << kPartBits | (place.part & kPartMask);
        visit(numbers[topic], time_ns, beginning, here);
      });
      for (const std::string& problem : file.problems())
        problems_.push_back(fmt::format("{}: {}", parts_[i].name, problem));
    }
  }

  const std::vector<BagTopic>& topics() const override { return topics_; }

  Bytes read(const BagPlace& place) override {
    BagPlace there = place;
    there.part = place.part & kPartMask;
    return parts_.at(place.part >> kPartBits).file->read(there);
  }

  const std::vector<std::string>& problems() const override { return problems_; }

 private:
  std::size_t number_of(const BagTopic& topic) {
    const auto same = std::ranges::find_if(topics_, [&](const BagTopic& other) {
      return other.name == topic.name && other.type == topic.type && other.encoding == topic.encoding;
    });
    const auto number = static_cast<std::size_t>(same - topics_.begin());
    if (same == topics_.end()) topics_.push_back(topic);
    return number;
  }

  std::vector<BagPart> parts_;
  std::vector<BagTopic> topics_;
  std::vector<std::string> problems_;
};

}  // namespace

std::unique_ptr<BagFile> join_bags(std::vector<BagPart> parts) {
  return std::make_unique<SplitBag>(std::move(parts));
}

}  // namespace saccade
