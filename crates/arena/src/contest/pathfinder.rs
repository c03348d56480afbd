use core::error::Error;

use tolman_maps::diktiometry::ObservedMove;
use tolman_robot::{
    Compass, Guess, Landmark, MapView, Mapper, Ranges, Robot, Rolls, SensesLandmarks, Standing,
    System, Task, TurnTranslate, VisitNaming,
};
use tolman_systems::diktiometry::{Diktiometer, DiktiometerConfig, Eye, Wayfinder};

use crate::BoxError;

/// The whole diktiometry: learns a map, and finds its way on the map after it was put down
/// anywhere.
#[derive(Debug)]
pub(crate) struct Pathfinder<E> {
    learner: Diktiometer<E>,
    /// Finder of the way since the robot was put down; `None` before.
    finder: Option<Wayfinder<E>>,
    eye: E,
    seed: u64,
}

impl<E: Clone> Pathfinder<E> {
    /// Returns a system without a map.
    pub(crate) fn learning(config: DiktiometerConfig, eye: E, seed: u64) -> Self {
        Self {
            learner: Diktiometer::new(config, eye.clone(), seed),
            finder: None,
            eye,
            seed,
        }
    }
}

impl<E> Mapper for Pathfinder<E> {
    type Observation = ObservedMove;
    type Error = BoxError;

    fn observe(&mut self, seen: &ObservedMove) -> Result<(), BoxError> {
        match &mut self.finder {
            None => Ok(self.learner.observe(seen)?),
            Some(finder) => Ok(finder.observe(seen)?),
        }
    }

    fn map(&self) -> MapView {
        self.learner.map()
    }

    fn belief(&self) -> Vec<Guess> {
        match &self.finder {
            None => self.learner.belief(),
            Some(finder) => finder.belief(),
        }
    }

    fn visit_naming(&self) -> VisitNaming {
        self.learner.visit_naming()
    }

    fn visits(&self) -> Vec<Option<u32>> {
        self.learner.visits()
    }

    fn certainty(&self) -> Option<f64> {
        self.learner.certainty()
    }

    fn doubt(&self) -> Option<String> {
        self.learner.doubt()
    }

    fn map_bytes(&self) -> Option<usize> {
        self.learner.map_bytes()
    }
}

impl<R, E> System<R> for Pathfinder<E>
where
    R: SensesLandmarks + Robot<Command = TurnTranslate, Error: Error + Send + Sync + 'static>,
    R::Sensing: Ranges + Compass + Rolls,
    E: Eye<R::Sensing> + Clone,
{
    type Failure = BoxError;

    fn act(&mut self, robot: &mut R, task: Task) -> Result<Standing, BoxError> {
        match &mut self.finder {
            None => Ok(self.learner.act(robot, task)?),
            Some(finder) => Ok(finder.act(robot, task)?),
        }
    }

    fn put_down(&mut self) -> Standing {
        let Some(observer) = self.learner.observer() else {
            return Standing::gave_up("it has no map to find itself on");
        };
        let goal = self.learner.spot_of(Landmark::Goal);
        let routines = self.learner.config().routines;
        let (eye, map) = (self.eye.clone(), observer.clone());
        self.finder = Some(Wayfinder::new(routines, eye, map, goal, self.seed));
        Standing::UnderWay
    }

    fn words(&self) -> String {
        match &self.finder {
            None => System::<R>::words(&self.learner),
            Some(finder) => System::<R>::words(finder),
        }
    }
}
