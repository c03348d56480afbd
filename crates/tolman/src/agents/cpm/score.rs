use alloc::collections::BTreeMap;

use tolman_control::heading_of;
use tolman_geom::Pose;
use tolman_maps::cpm::{Arrival, CpMap, FragmentId, JunctionId};
use tolman_maze::{Cell, Direction, Maze};
use tolman_planners::{Arcs, costs_from};
use tolman_sim::World;

use super::agent::{Cpm, Step};
use super::body::SimulatedEpuck;
use super::fragments::{TrueFragments, Way};
use super::known_map::KnownMap;
use super::layout::Layout;
use super::walker::Walk;

/// Loops closed in the first episode: arrivals by a way that was not on the map.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Closures {
    /// A duplicate was told, and it was that one; on arrival, or by what was met later.
    pub right: u32,
    /// A duplicate was told, and it was another or none.
    pub wrong: u32,
    /// A fragment was walked again, and still is on the map at the end as another one.
    pub missed: u32,
}

/// What really happened, for scoring.
pub(super) struct Score<'a> {
    fragments: TrueFragments,
    closures: Closures,
    /// The true way from − to + of each fragment of the map.
    pub(super) truth: BTreeMap<FragmentId, Way>,
    /// The cell of each place of the map.
    places: BTreeMap<JunctionId, Cell>,
    /// Observations of each true fragment when it was first walked.
    pub(super) lengths: BTreeMap<u32, u32>,
    pub(super) known: KnownMap<'a>,
}

impl<'a> Score<'a> {
    pub(super) fn of(maze: &'a Maze) -> Self {
        Self {
            fragments: TrueFragments::of(maze),
            closures: Closures::default(),
            truth: BTreeMap::new(),
            places: BTreeMap::new(),
            lengths: BTreeMap::new(),
            known: KnownMap::new(maze),
        }
    }

    pub(super) fn begin(&mut self, agent: &Cpm<'_, SimulatedEpuck>, start: Pose) {
        if let Some(cell) = agent.walker().body().world().cell_at(start.position) {
            self.places.insert(agent.explorer().at().junction, cell);
        }
    }

    pub(super) fn see(&mut self, agent: &Cpm<'_, SimulatedEpuck>, step: &Step, maze: &Maze) {
        let (Some(arrival), Walk::Arrived { observations, .. }) = (step.arrival, &step.walk) else {
            return;
        };
        let body = agent.walker().body();
        let here = body.world().cell_at(body.truth().pose.position);
        let way = agent.walker().departed_at(body.path()).and_then(|from| {
            let cell = body.world().cell_at(from.position)?;
            self.fragments.way(cell, from.heading)
        });
        let length = (observations.len() as u32).max(1);
        if let Some(here) = here {
            let way = way.filter(|way| way.to == here);
            let before = way.and_then(|way| self.lengths.get(&way.fragment));
            self.known.walk(way, here, *before.unwrap_or(&length));
        }
        let Some(way) = way else {
            return;
        };
        let is_old = self.lengths.contains_key(&way.fragment);
        let told = agent.explorer().map().end_at(agent.explorer().at());
        let known = told.and_then(|end| self.truth.get(&end.fragment).copied());
        let is_same = known.is_some_and(|known| known.fragment == way.fragment);
        // The place that the map says it is at, where that is a place of the map.
        let junction = agent.explorer().at().junction;
        let stands = self.places.get(&junction).copied();
        if let Some(here) = here {
            self.places.entry(junction).or_insert(here);
        }
        match arrival {
            Arrival::Revised => self.lay_anew(agent.explorer().map(), maze),
            Arrival::Duplicate if is_same => self.closures.right += 1,
            Arrival::Duplicate => self.closures.wrong += 1,
            Arrival::Loop if stands == here => self.closures.right += 1,
            Arrival::Loop => self.closures.wrong += 1,
            Arrival::New if is_old => self.closures.missed += 1,
            _ => {}
        }
        if let Some(end) = told {
            self.truth.entry(end.fragment).or_insert(way);
        }
        self.lengths.entry(way.fragment).or_insert(length);
    }

    /// Another map has its own names of fragments and places: where they lie follows from laying it over the maze.
    fn lay_anew(&mut self, map: &CpMap, maze: &Maze) {
        let layout = Layout::of(map, maze);
        let place = |(id, _)| Some((id, layout.place(id)?));
        self.places = map.junctions().filter_map(place).collect();
        let way = |(id, _)| {
            let cells = &layout.course(id)?.cells;
            let (from, next) = (cells.first()?, cells.get(1)?);
            let (out, _) = maze.neighbours(*from).find(|(_, cell)| cell == next)?;
            Some((id, self.fragments.way(*from, heading_of(out))?))
        };
        self.truth = map.fragments().filter_map(way).collect();
    }

    /// Loops count as closed too that were closed after the arrival, by another fragment or another map, and as missed those that are open on
    /// the map at the end, where a fragment is on it more than once.
    pub(super) fn closures_at_the_end(&self, map: &CpMap) -> Closures {
        let known = map.fragments().filter_map(|(id, _)| self.truth.get(&id));
        let mut fragments: Vec<u32> = known.map(|way| way.fragment).collect();
        let all = fragments.len();
        fragments.sort_unstable();
        fragments.dedup();
        let open = (all - fragments.len()) as u32;
        Closures {
            right: self.closures.right + self.closures.missed.saturating_sub(open),
            missed: open,
            ..self.closures
        }
    }

    /// The length of the shortest way from start to goal over the fragments that were walked, by observations.
    pub(super) fn shortest_as_it_lies(&self, maze: &Maze) -> Option<u32> {
        let (start, _) = maze.start()?;
        let node = |cell: Cell| maze.grid().index(cell) as u32;
        let walked = |(from, _, way): (Cell, Direction, Way)| {
            let length = self.lengths.get(&way.fragment)?;
            Some((node(from), node(way.to), *length))
        };
        let arcs: Vec<_> = self.fragments.ways().filter_map(walked).collect();
        let costs = costs_from(&Arcs::new(maze.grid().cell_count(), &arcs), [node(start)]);
        let goals = maze.goals().iter();
        goals.filter_map(|goal| costs[node(*goal) as usize]).min()
    }

    /// The length of a drive, in observations of the fragments it was along; none if one of them was not walked before.
    pub(super) fn length_of(&self, world: &World, path: &[Pose]) -> Option<u32> {
        let cells = path.iter().filter_map(|pose| world.cell_at(pose.position));
        let driven = self.fragments.driven(cells)?;
        let lengths = driven
            .iter()
            .map(|way| self.lengths.get(&way.fragment).copied());
        lengths.sum()
    }
}
