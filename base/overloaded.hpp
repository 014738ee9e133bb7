#pragma once
/// \file
/// overloaded{...}: a visitor of a std::variant made of lambdas. Without a catch-all a new alternative fails to compile
/// wherever it is not handled.

namespace axil {

template <class... Fs>
struct overloaded : Fs... {
  using Fs::operator()...;
};
template <class... Fs>
overloaded(Fs...) -> overloaded<Fs...>;

}  // namespace axil
