#pragma once
// What every object that rays touch promises: the same answer to the same question, whoever asks,
// when and how often, and no memory asked for.

#include <array>
#include <chrono>
#include <cstring>
#include <latch>
#include <thread>

#include "allocations.h"
#include "law.h"

namespace pbrt::laws {

// `Questions` is made from a Subject, may have `names` of the numbers in an answer, has `count`,
// ask(i) -> std::array<float, N> and about(i), which tells a person the question. Asking allocates
// nothing, but for what the plug-in allocates.
template <class Questions>
struct Steady {
  using Answer = decltype(std::declval<const Questions&>().ask(0));

  static bool same(const Answer& a, const Answer& b) {
    return std::memcmp(&a, &b, sizeof a) == 0;  // NaN is the same as itself
  }
  static std::vector<Answer> answers(const Questions& questions) {
    std::vector<Answer> all;
    for (int i = 0; i < questions.count; ++i) all.push_back(questions.ask(i));
    return all;
  }
  // The first few numbers in which two answers differ, if the questions have names for them.
  static std::string difference(const Answer& a, const Answer& b) {
    if constexpr (requires { Questions::names; }) {
      std::string text;
      int told = 0;
      for (std::size_t i = 0; i < a.size() && told < 3; ++i)
        if (std::memcmp(&a[i], &b[i], sizeof a[i]) != 0)
          text += fmt::format("{}{} = {}, then {}", told++ == 0 ? "" : "; ", Questions::names[i],
                              a[i], b[i]);
      return text;
    } else {
      return fmt::format("{}, then {}", fmt::join(a, " "), fmt::join(b, " "));
    }
  }
  static void compare(const Questions& questions, int i, const Answer& a, const Answer& b,
                      std::string_view when, Judge& judge) {
    judge.expect(same(a, b), "{}: {} {}", questions.about(i), difference(a, b), when);
  }

  static void repeatable(const Subject& subject, Judge& judge) {
    const Questions questions(subject);
    const auto first = answers(questions);
    for (int i = questions.count - 1; i >= 0; --i)
      for (int again = 0; again < 2; ++again)
        compare(questions, i, first[i], questions.ask(i), "when asked again, in another order",
                judge);
  }

  static void twins(const Subject& subject, Judge& judge) {
    const Questions one(subject), other(subject);
    const auto first = answers(one), second = answers(other);
    for (int i = 0; i < one.count; ++i)
      compare(one, i, first[i], second[i], "from another object of the same parameters", judge);
  }

  static void threadSafe(const Subject& subject, Judge& judge) {
    // Long enough for the threads to be interrupted anywhere, where cores are few.
    constexpr std::chrono::milliseconds time(100);
    constexpr int threads = 4;
    const Questions questions(subject);
    const auto alone = answers(questions);
    std::array<std::vector<std::pair<int, Answer>>, threads> differ;
    std::latch start(threads);
    std::vector<std::jthread> running;
    for (int t = 0; t < threads; ++t)
      running.emplace_back([&, t] {
        start.arrive_and_wait();
        const auto end = std::chrono::steady_clock::now() + time;
        do {
          for (int k = 0; k < questions.count && differ[t].size() < Judge::kMostKept; ++k) {
            const int i = (k + t * questions.count / threads) % questions.count;
            const Answer answer = questions.ask(i);
            if (!same(alone[i], answer)) differ[t].push_back({i, answer});
          }
        } while (std::chrono::steady_clock::now() < end && differ[t].empty());
      });
    running.clear();  // waits for them
    for (const auto& of : differ) {
      judge.expect(true, "");
      for (const auto& [i, answer] : of)
        compare(questions, i, alone[i], answer, "while other threads ask as well", judge);
    }
  }

  static void allocatesNothing(const Subject& subject, Judge& judge) {
    if (!countsAllocations()) return judge.skip("this program does not count what it allocates");
    const Questions questions(subject);
    for (int i = 0; i < questions.count; ++i) {
      const std::size_t before = allocations();
      questions.ask(i);
      const std::size_t made = allocations() - before;
      judge.expect(made == 0, "{}: memory was asked for {} times (operator new)",
                   questions.about(i), made);
    }
  }

  static constexpr std::array<Law, 4> laws = {{
      {"repeatable", "an answer does not depend on the questions before it", repeatable},
      {"twins", "two objects of the same parameters give the same answers", twins},
      {"thread-safe", "many threads at once get the same answers as one", threadSafe},
      {"allocates-nothing", "what rays touch asks for no memory", allocatesNothing},
  }};
};

// The laws of one kind and those above.
template <class Questions, std::size_t n>
std::array<Law, n + 4> withSteady(const std::array<Law, n>& own) {
  std::array<Law, n + 4> all;
  std::copy(own.begin(), own.end(), all.begin());
  std::copy(Steady<Questions>::laws.begin(), Steady<Questions>::laws.end(), all.begin() + n);
  return all;
}

}  // namespace pbrt::laws
