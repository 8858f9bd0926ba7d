#include "optimizer/workers/mpi_pool.hpp"

#include <fmt/format.h>
#include <mpi.h>

#include <chrono>
#include <exception>
#include <iostream>
#include <thread>
#include <utility>

namespace dovetail::optimizer {

namespace {

/// What a message is about; an answer has one of the last two.
enum Tag : int { kPrepare = 1, kTask, kDismiss, kAnswer, kFailed };

void send(int rank, int tag, const std::string& text) {
  MPI_Send(text.data(), static_cast<int>(text.size()), MPI_CHAR, rank, tag, MPI_COMM_WORLD);
}

struct Message {
  int rank = 0, tag = 0;
  std::string text = {};
};

/// The next message, if there is one. Waiting in MPI would keep a core busy.
std::optional<Message> poll(int from) {
  int there = 0;
  MPI_Status status;
  MPI_Iprobe(from, MPI_ANY_TAG, MPI_COMM_WORLD, &there, &status);
  if (there == 0) return {};
  int size = 0;
  MPI_Get_count(&status, MPI_CHAR, &size);
  Message message{
      .rank = status.MPI_SOURCE, .tag = status.MPI_TAG, .text = std::string(static_cast<std::size_t>(size), '\0')};
  MPI_Recv(message.text.data(), size, MPI_CHAR, message.rank, message.tag, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
  return message;
}

/// Between two looks for a message: nothing beside an evaluation.
constexpr std::chrono::milliseconds kPause{2};

int ranks() {
  int size = 0;
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  return size;
}

}  // namespace

MpiPool::MpiPool(double patience_s) : patience_(patience_s), lost_(static_cast<std::size_t>(ranks())) {}

std::size_t MpiPool::size() const {
  return lost_.size() - 1;
}

void MpiPool::prepare(const std::string& common) {
  for (int rank = 1; rank < ranks(); ++rank)
    if (!lost_[static_cast<std::size_t>(rank)]) send(rank, kPrepare, common);
}

void MpiPool::run(std::span<const std::string> tasks, const std::function<bool(Finished)>& told) {
  using Clock = std::chrono::steady_clock;
  struct UnderWay {
    std::size_t task;
    Clock::time_point since;
  };
  std::vector<std::optional<UnderWay>> under_way(lost_.size());
  std::size_t next = 0, count = 0;
  bool goes_on = true;
  const auto tell = [&](std::size_t rank, Finished finished) {
    under_way[rank].reset();
    --count;
    goes_on = told(std::move(finished)) && goes_on;
  };
  while (true) {
    bool anybody = false;
    for (std::size_t rank = 1; rank < lost_.size(); ++rank) {
      anybody = anybody || !lost_[rank];
      if (!goes_on || next == tasks.size() || lost_[rank] || under_way[rank]) continue;
      send(static_cast<int>(rank), kTask, tasks[next]);
      under_way[rank] = {.task = next++, .since = Clock::now()};
      ++count;
    }
    if (!anybody)  // nobody is left who could answer
      for (; goes_on && next < tasks.size(); ++next)
        goes_on = told({.task = next, .ended = "found no rank to work on it"});
    if (count == 0) return;
    while (const std::optional<Message> message = poll(MPI_ANY_SOURCE)) {
      const auto rank = static_cast<std::size_t>(message->rank);
      if (!under_way[rank]) continue;  // of a task that was given up
      Finished finished{.task = under_way[rank]->task};
      if (message->tag == kAnswer)
        finished.answer = message->text;
      else
        finished.ended = "ended with: " + message->text;
      tell(rank, std::move(finished));
    }
    for (std::size_t rank = 1; rank < lost_.size(); ++rank)
      if (under_way[rank] && std::chrono::duration<double>(Clock::now() - under_way[rank]->since).count() > patience_) {
        lost_[rank] = true;
        tell(rank, {.task = under_way[rank]->task, .ended = fmt::format("gave no answer in {:g} s", patience_)});
      }
    std::this_thread::sleep_for(kPause);
  }
}

void serve(const WorkerFactory& factory) {
  Worker worker;
  while (true) {
    const std::optional<Message> message = poll(0);
    if (!message) {
      std::this_thread::sleep_for(kPause);
      continue;
    }
    if (message->tag == kDismiss) return;
    try {
      if (message->tag == kPrepare)
        worker = factory(message->text);
      else
        send(0, kAnswer, worker(message->text));
    } catch (const std::exception& error) {
      if (message->tag == kTask) send(0, kFailed, error.what());
      std::cerr << "dovetail: a rank: " << error.what() << std::endl;
    }
  }
}

void dismiss() {
  for (int rank = 1; rank < ranks(); ++rank) send(rank, kDismiss, {});
}

}  // namespace dovetail::optimizer
