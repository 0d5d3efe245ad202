// A room that Python code may change, and that results keep as it was when they were made.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <string_view>
#include <type_traits>
#include <utility>

#include "lichtmc/prepared_room.hpp"
#include "lichtmc/room.hpp"

namespace lichtmc::python {

// What hears of the steps of a preparation that this thread carries out; null: nothing does.
using StepListener = std::function<void(std::string_view)>;
inline thread_local const StepListener* step_listener = nullptr;

// A room, and what is known of its surfaces (lichtmc/prepared_room.hpp), which a second run then need not find again.
class KeptRoom {
 public:
  explicit KeptRoom(Room of) : room(std::move(of)) {}
  KeptRoom(const KeptRoom&) = delete;
  KeptRoom& operator=(const KeptRoom&) = delete;

  // For work on this number of threads (0: one per processor).
  std::shared_ptr<PreparedRoom> prepared(unsigned threads) const {
    const std::scoped_lock lock(mutex_);
    if (!prepared_ || threads_ != threads) {
      prepared_ = prepare(room, threads, [](std::string_view step) {
        if (step_listener != nullptr) (*step_listener)(step);
      });
      threads_ = threads;
    }
    return prepared_;
  }

  const Room room;

 private:
  mutable std::mutex mutex_;
  mutable std::shared_ptr<PreparedRoom> prepared_;  // ends before the room
  mutable unsigned threads_ = 0;
};

// Copy on write: any number of results and copies share a room; a change is made to a copy of its own.
class SharedRoom {
 public:
  explicit SharedRoom(Room room) : kept_(std::make_shared<KeptRoom>(std::move(room))) {}
  explicit SharedRoom(std::shared_ptr<const KeptRoom> kept) : kept_(std::move(kept)) {}

  const Room& room() const { return kept_->room; }
  const std::shared_ptr<const KeptRoom>& kept() const { return kept_; }

  // Changes the room by `change(Room&)`, whose value is returned; if that throws, the room is as before.
  template <class Change>
  auto change(const Change& change) {
    Room changed = kept_->room;
    if constexpr (std::is_void_v<decltype(change(changed))>) {
      change(changed);
      kept_ = std::make_shared<KeptRoom>(std::move(changed));
    } else {
      auto value = change(changed);
      kept_ = std::make_shared<KeptRoom>(std::move(changed));
      return value;
    }
  }

 private:
  std::shared_ptr<const KeptRoom> kept_;
};

}  // namespace lichtmc::python
