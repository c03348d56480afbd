use core::iter;
use core::marker::PhantomData;

use super::CellTimes;
use super::moves::{Side, Slalom};
use super::state::{Facing, Node, STATES_PER_CELL, beside, left, opposite, right};
use super::times::turn_number;
use crate::Passages;

/// Number of bits for the ways to one side. Five are used: see [`ends`].
const SIDE: usize = 8;
/// Bit 0 of both sides.
const BOTH: u32 = 1 | 1 << SIDE;

/// Ways out of a state, in whatever cell it is. Nothing foresees which walls there are, so ways are
/// looked up and masked, not branched on.
#[derive(Clone, Copy)]
struct Ways {
    /// Direction in which the mouse leaves its cell.
    ahead: u8,
    back: u8,
    /// Directions in which it leaves the next cell, for turns to the left and to the right.
    aside: [u8; 2],
    /// Distances to the next cell, to those aside of it, and to those that lie behind these.
    next: i16,
    far: [i16; 2],
    near: [i16; 2],
    /// Bit n: way n is a turn. Those to the right begin with bit [`SIDE`].
    are_turns: u16,
    turns: [[Turn; SIDE]; 2],
    /// Sides and ends of the next two steps of a straight. On a diagonal they take turns.
    steps: [(u8, Offset); 2],
    /// The same in steps of half a cell. Those to the middle of a cell have the side behind them,
    /// which is open.
    halves: [(u8, Offset); 2],
    /// 1 on a straight. A diagonal has to lead on where it ends.
    may_end: u8,
}

/// A turn out of a state, in eight bytes: a search looks at tens of thousands.
#[derive(Clone, Copy)]
pub(super) struct Turn {
    pub(super) slalom: Slalom,
    pub(super) side: Side,
    /// [`turn_number`] of the turn that is driven backwards: one to the other side.
    pub(super) backwards: u8,
    /// State in which it ends, and its cell.
    end_state: u8,
    end_cells: i16,
    /// How far its end is from its beginning, if states are numbered from cell to cell.
    pub(super) states: i16,
}

impl Turn {
    #[inline(always)]
    pub(super) fn end(self, from: Node) -> Node {
        let end = Offset {
            cells: self.end_cells,
            state: self.end_state,
        };
        end.from(from)
    }
}

/// State at some distance from another.
#[derive(Clone, Copy)]
struct Offset {
    cells: i16,
    state: u8,
}

impl Offset {
    const fn between(from: Node, to: Node) -> Self {
        Self {
            cells: to.cell.wrapping_sub(from.cell) as i16,
            state: to.state as u8,
        }
    }

    #[inline(always)]
    fn from(self, node: Node) -> Node {
        Node {
            cell: node.cell.wrapping_add_signed(self.cells.into()),
            state: self.state.into(),
        }
    }
}

/// Returns the ends of the ways from cell 0 that turn aside behind the next cell. They end in the
/// next cell, and in the one aside of that, looking aside or on along a diagonal; and in the cell
/// behind that one, looking back or aside along a diagonal.
const fn ends<const N: usize>(ahead: usize, aside: usize) -> [Node; 5] {
    let back = opposite(ahead);
    let next = beside::<N>(0, ahead);
    let far = beside::<N>(next, aside);
    let near = beside::<N>(far, back);
    [
        Node::straight(next, ahead),
        Node::straight(far, aside),
        Node::diagonal(far, aside, ahead),
        Node::straight(near, back),
        Node::diagonal(near, back, aside),
    ]
}

impl Ways {
    /// Returns the ways of a state, for maps with `states` times of each cell.
    const fn of<const N: usize>(state: usize, states: usize) -> Self {
        use Slalom::{F45, F90, F135, F180, Fs90, Fv90};
        let from = Node::numbered(0, state);
        let (ahead, aside, are_turns, slaloms, steps) = match from.facing() {
            Facing::Straight(ahead) => {
                let step = (ahead, Node::straight(beside::<N>(0, ahead), ahead), from);
                let slaloms = [F90, F90, F45, F180, F135];
                let aside = [left(ahead), right(ahead)];
                (ahead, aside, 0b11110 * BOTH as u16, slaloms, [step; 2])
            }
            Facing::Diagonal(into, out) => {
                let next = Node::diagonal(beside::<N>(0, out), out, into);
                let beyond = Node::diagonal(beside::<N>(next.cell, into), into, out);
                let steps = [(out, next, from), (into, beyond, next)];
                let to_left = out == left(into);
                let are_turns = if to_left { 0b00111 } else { 0b00111 << SIDE };
                let slaloms = [F45, F135, Fv90, Fv90, Fv90];
                (out, [opposite(into); 2], are_turns, slaloms, steps)
            }
            // The side that the mouse enters by is open, as is one ahead of others.
            Facing::Edge(heading) => {
                let step = (opposite(heading), Node::straight(0, heading), from);
                let aside = [left(heading), right(heading)];
                let back = opposite(heading);
                (back, aside, 0b00010 * BOTH as u16, [Fs90; 5], [step; 2])
            }
        };
        let halves = match from.facing() {
            Facing::Straight(heading) => {
                let edge = Node::edge(beside::<N>(0, heading), heading);
                let middle = Node::straight(edge.cell, heading);
                [(heading, edge, from), (opposite(heading), middle, edge)]
            }
            Facing::Edge(heading) => {
                let middle = Node::straight(0, heading);
                let edge = Node::edge(beside::<N>(0, heading), heading);
                [(opposite(heading), middle, from), (heading, edge, middle)]
            }
            Facing::Diagonal(..) => steps,
        };
        let [left, right] = aside;
        let (mut left_ends, mut right_ends) = (ends::<N>(ahead, left), ends::<N>(ahead, right));
        if let Facing::Edge(_) = from.facing() {
            left_ends[0] = from;
            left_ends[1] = Node::edge(beside::<N>(0, left), left);
            right_ends[1] = Node::edge(beside::<N>(0, right), right);
        }
        Self {
            ahead: ahead as u8,
            back: opposite(ahead) as u8,
            aside: [left as u8, right as u8],
            next: left_ends[0].cell as i16,
            far: [left_ends[1].cell as i16, right_ends[1].cell as i16],
            near: [left_ends[3].cell as i16, right_ends[3].cell as i16],
            are_turns,
            turns: [
                turns_to((from, states), left_ends, slaloms, Side::Left),
                turns_to((from, states), right_ends, slaloms, Side::Right),
            ],
            steps: [step(steps[0]), step(steps[1])],
            halves: [step(halves[0]), step(halves[1])],
            may_end: !matches!(from.facing(), Facing::Diagonal(..)) as u8,
        }
    }
}

const fn step((side, to, from): (usize, Node, Node)) -> (u8, Offset) {
    (side as u8, Offset::between(from, to))
}

const fn turns_to(
    (from, states): (Node, usize),
    ends: [Node; 5],
    slaloms: [Slalom; 5],
    side: Side,
) -> [Turn; SIDE] {
    let mut turns = [Turn {
        slalom: Slalom::F90,
        side,
        backwards: 0,
        end_state: 0,
        end_cells: 0,
        states: 0,
    }; SIDE];
    let mut way = 0;
    while way < ends.len() {
        let end = Offset::between(from, ends[way]);
        let states = end.cells * states as i16 + end.state as i16 - from.state as i16;
        turns[way] = Turn {
            slalom: slaloms[way],
            side,
            backwards: turn_number(slaloms[way], side.opposite()) as u8,
            end_state: end.state,
            end_cells: end.cells,
            states,
        };
        way += 1;
    }
    turns
}

/// Ways of each state, in mazes whose rows are `N` cells apart, for maps with these times.
struct Table<const N: usize, C>(PhantomData<C>);

impl<const N: usize, C: CellTimes> Table<N, C> {
    const WAYS: [Ways; 16] = {
        let mut all = [Ways::of::<N>(0, C::STATES); 16];
        let mut state = 1;
        while state < STATES_PER_CELL {
            all[state] = Ways::of::<N>(state, C::STATES);
            state += 1;
        }
        all
    };

    #[inline(always)]
    fn ways(node: Node) -> &'static Ways {
        let all = const { &Self::WAYS };
        &all[node.state % 16]
    }
}

impl<const N: usize> Passages<N> {
    /// Returns the open sides of a cell. Beyond the last cell the first follows; no open side leads
    /// there.
    #[inline(always)]
    fn around(&self, cell: usize) -> u32 {
        let sides = self.sides().get(cell % (N * N));
        sides.copied().unwrap_or(0).into()
    }
}

/// Returns every turn that can be made from `node`, always in the same order.
///
/// A turn onto a diagonal is made only if the diagonal leads out of the cell it enters: otherwise
/// nothing could follow.
#[inline(always)]
pub(super) fn turns<const N: usize, C: CellTimes>(
    passages: &Passages<N>,
    node: Node,
) -> impl Iterator<Item = &'static Turn> {
    let ways = Table::<N, C>::ways(node);
    let at = |cells: i16| passages.around(node.cell.wrapping_add_signed(cells.into()));
    let [left, right] = ways.aside;
    let first = at(0) >> ways.ahead & 1;
    let mut open = if ways.may_end == 0 {
        // A diagonal has turns to one side, and the same walls beside it for both.
        let second = first & at(ways.next) >> left;
        let on = second & at(ways.far[0]) >> ways.ahead;
        (first | second << 1 | on << 2) * BOTH
    } else {
        let both = |[left, right]: [u32; 2]| left | right << SIDE;
        let aside =
            |[to_left, to_right]: [u32; 2]| both([to_left >> left & 1, to_right >> right & 1]);
        let first = first * BOTH;
        let second = first & aside([at(ways.next); 2]);
        let far = both(ways.far.map(at));
        let on = second & far >> ways.ahead;
        let round = second & far >> ways.back;
        let again = round & aside(ways.near.map(at));
        first | second << 1 | on << 2 | round << 3 | again << 4
    };
    open &= u32::from(ways.are_turns);
    iter::from_fn(move || {
        if open == 0 {
            return None;
        }
        let way = open.trailing_zeros() as usize;
        open &= open - 1;
        ways.turns.as_flattened().get(way % (2 * SIDE))
    })
}

/// Returns every length and end of the straights that lead on from `node`, nearest first. Lengths
/// are in cells; with `has_halves`, those of straights in half cells.
pub(super) fn straights<const N: usize, C: CellTimes>(
    passages: &Passages<N>,
    node: Node,
    has_halves: bool,
) -> impl Iterator<Item = (usize, Node)> {
    let open = line::<N, C>(passages, node, has_halves);
    (1..).zip(open.map_while(|(to, is_open)| is_open.then_some(to)))
}

/// Returns the ends that [`straights`] does, and goes on behind walls: each item says whether the
/// straight is open that far, if it is up to the one before.
#[inline(always)]
pub(super) fn line<const N: usize, C: CellTimes>(
    passages: &Passages<N>,
    node: Node,
    has_halves: bool,
) -> impl Iterator<Item = (Node, bool)> {
    let ways = Table::<N, C>::ways(node);
    let [mut step, mut then] = if has_halves { ways.halves } else { ways.steps };
    let mut to = node;
    let mut sides = passages.around(node.cell);
    iter::repeat_with(move || {
        let (side, end) = step;
        let open = sides >> side;
        to = end.from(to);
        (step, then) = (then, step);
        sides = passages.around(to.cell);
        let leads_on = sides >> step.0 | u32::from(ways.may_end);
        (to, open & leads_on & 1 == 1)
    })
}
