#pragma once

#include <cstddef>
#include <cstring>
#include <functional>
#include <map>
#include <string>
#include <type_traits>
#include <utility>

#include <Driver/OniDriverAPI.h>

namespace saccade {

/// The properties of a device or a stream of an OpenNI2 driver module. A property is a plain value of a fixed
/// size, or a text. Filled once by the owner's constructor; the functions given to it guard the data that
/// they use, so that get() and set() may be called on any thread.
class PropertyTable {
 public:
  /// A property that can be read, and written if `set` is given; `set` returns whether it accepts the value.
  template <typename T>
  void add(int id, std::function<T()> get, std::function<OniStatus(const T&)> set = {}) {
    static_assert(std::is_trivially_copyable_v<T>);
    Property property;
    property.capacity = sizeof(T);
    property.get = [get = std::move(get)](void* data, int* size) {
      if (*size != static_cast<int>(sizeof(T))) return ONI_STATUS_BAD_PARAMETER;
      const T value = get();
      std::memcpy(data, &value, sizeof value);
      return ONI_STATUS_OK;
    };
    if (set)
      property.set = [set = std::move(set)](const void* data, int size) {
        if (size != static_cast<int>(sizeof(T))) return ONI_STATUS_BAD_PARAMETER;
        T value;
        std::memcpy(&value, data, sizeof value);
        return set(value);
      };
    properties_[id] = std::move(property);
  }

  /// A text that is read only; the reader's buffer must have room for it and its zero.
  void add_text(int id, const std::string& text) {
    Property property;
    property.capacity = text.size() + 1;
    property.get = [text](void* data, int* size) {
      const auto needed = static_cast<int>(text.size() + 1);
      if (*size < needed) return ONI_STATUS_BAD_PARAMETER;
      std::memcpy(data, text.c_str(), text.size() + 1);
      *size = needed;
      return ONI_STATUS_OK;
    };
    properties_[id] = std::move(property);
  }

  bool has(int id) const { return properties_.contains(id); }

  OniStatus get(int id, void* data, int* size) const {
    const auto found = properties_.find(id);
    if (found == properties_.end()) return ONI_STATUS_NOT_SUPPORTED;
    if (data == nullptr || size == nullptr) return ONI_STATUS_BAD_PARAMETER;
    return found->second.get(data, size);
  }

  OniStatus set(int id, const void* data, int size) const {
    const auto found = properties_.find(id);
    if (found == properties_.end() || !found->second.set) return ONI_STATUS_NOT_SUPPORTED;
    if (data == nullptr) return ONI_STATUS_BAD_PARAMETER;
    return found->second.set(data, size);
  }

  /// Calls report(id, data, size) with each property's value, for a recorder that was attached.
  template <typename Report>
  void for_each(Report report) const {
    for (const auto& [id, property] : properties_) {
      std::string value(property.capacity, '\0');
      int size = static_cast<int>(value.size());
      if (property.get(value.data(), &size) == ONI_STATUS_OK) report(id, value.data(), size);
    }
  }

 private:
  struct Property {
    std::size_t capacity = 0;
    std::function<OniStatus(void*, int*)> get;
    std::function<OniStatus(const void*, int)> set;  // empty = read only
  };

  std::map<int, Property> properties_;
};

}  // namespace saccade
