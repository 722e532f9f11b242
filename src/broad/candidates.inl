// The end of a list of candidates, kept in registers while a block is searched.

/// The end of a list, kept in registers while a block is searched.
struct ListEnd {
  std::uint32_t* i;
  std::uint32_t* j;
  std::size_t count, capacity;
};

HWY_INLINE ListEnd end_of(const Candidates& list) {
  return {list.i, list.j, list.count, list.capacity};
}

HWY_NOINLINE ListEnd make_room(ListEnd end, Candidates& list, RoomMaker& room) {
  list.count = end.count;
  room.make_room(room, list);
  return end_of(list);
}

/// What a search carries from test to test: the end of its list and the doubt about it.
template <class Shape>
struct Cursor : ListEnd {
  [[no_unique_address]] typename Shape::Doubt doubt;

  HWY_INLINE explicit Cursor(const Candidates& list) : ListEnd(end_of(list)) {}
};

/// Exactly as many bytes as the mask has, so that it stays in registers.
template <class D, class M>
HWY_INLINE std::uint32_t mask_bits(D d, const M& mask) {
  std::conditional_t<(hn::MaxLanes(D()) > 8), std::uint16_t, std::uint8_t> bits;
  hn::StoreMaskBits(d, mask, reinterpret_cast<std::uint8_t*>(&bits));
  return bits;
}

/// Appends the lanes of `hits`, whose bodies start at sorted position j, as partners of body i;
/// without a branch, because which tests hit is unpredictable.
template <class D, class M>
HWY_INLINE void append(D d, const M& hits, std::uint32_t i, std::uint32_t j, ListEnd& cursor) {
  const hn::Rebind<std::uint32_t, D> du;
  const auto partners = hn::Add(hn::Set(du, j), hn::Iota(du, 0));
  if constexpr (sizeof(hn::TFromD<D>) == sizeof(std::uint32_t)) {
    hn::StoreU(hn::Compress(partners, hn::RebindMask(du, hits)), du, cursor.j + cursor.count);
  } else {
    std::uint8_t bits[sizeof(std::uint64_t)];
    hn::StoreMaskBits(d, hits, bits);
    const auto same = hn::LoadMaskBits(du, bits);
    hn::StoreU(hn::Compress(partners, same), du, cursor.j + cursor.count);
  }
  hn::StoreU(hn::Set(du, i), du, cursor.i + cursor.count);
  cursor.count += hn::CountTrue(d, hits);
}
