use anyhow::{Context as _, Result};
use ros2_client::action::{
    ActionServer, ActionServerQosPolicies, CancelGoalResponse, GetResultResponse, GoalId, GoalInfo,
    GoalStatusEnum, SendGoalResponse,
};
use ros2_client::action_msgs::{CancelGoalResponseEnum, GoalStatus, GoalStatusArray};
use ros2_client::builtin_interfaces::Time;
use ros2_client::qos::{Durability, History};
use ros2_client::{ActionTypeName, Name, Node, QosProfile, RmwRequestId, ServiceMapping};
use tolman_geom::Pose;

use crate::messages::{NavigateFeedback, NavigateGoal, NavigateResult};

/// The action `NavigateToPose` of nav2, one goal at a time: a new goal takes the place of the old.
pub(crate) struct Navigation {
    server: ActionServer<NavigateGoal, NavigateResult, NavigateFeedback>,
    /// Goals in the order in which they came, the last one is pursued.
    goals: Vec<Goal>,
    /// Clients that wait for the end of a goal.
    waiting: Vec<(RmwRequestId, GoalId)>,
}

struct Goal {
    id: GoalId,
    accepted: Time,
    status: GoalStatusEnum,
    pose: Pose,
    result: NavigateResult,
    is_new: bool,
}

/// Number of ended goals that are remembered, for clients that ask late.
const REMEMBERED: usize = 16;

impl Navigation {
    /// Returns a server for the action `name`.
    ///
    /// # Errors
    /// If DDS refuses it.
    pub(crate) fn new(node: &mut Node, name: &str, mapping: ServiceMapping) -> Result<Self> {
        let each = QosProfile::publisher_default().history(History::KeepLast { depth: 10 });
        let latched = each.clone().durability(Durability::TransientLocal);
        let qos = ActionServerQosPolicies {
            goal_service: each.clone(),
            result_service: each.clone(),
            cancel_service: each.clone(),
            feedback_publisher: each,
            status_publisher: latched,
        };
        let absolute = format!("/{}", name.trim_start_matches('/'));
        let parsed = Name::parse(&absolute).context("the action's name is invalid")?;
        let of = ActionTypeName::new("nav2_msgs", "NavigateToPose");
        let server = node.create_action_server(mapping, &parsed, &of, qos);
        Ok(Self {
            server: server.context("cannot serve the action")?,
            goals: Vec::new(),
            waiting: Vec::new(),
        })
    }

    /// Takes in goals, cancellations and questions for results.
    pub(crate) fn attend(&mut self) {
        while let Ok(Some((request, sent))) = self.server.receive_goal() {
            self.end_last(GoalStatusEnum::Aborted, "another goal came");
            let accepted = Time::now();
            self.goals.push(Goal {
                id: sent.goal_id,
                accepted,
                status: GoalStatusEnum::Executing,
                pose: sent.goal.pose.pose.into(),
                result: NavigateResult::default(),
                is_new: true,
            });
            let response = SendGoalResponse {
                accepted: true,
                stamp: accepted,
            };
            // Who has gone needs no answer.
            let _ = self.server.send_goal_response(request, response);
            self.tell();
        }
        while let Ok(Some((request, _))) = self.server.receive_cancel_request() {
            let pursued = self.goals.last_mut().filter(|goal| goal.is_pursued());
            let cancelling = pursued.map(|goal| {
                goal.status = GoalStatusEnum::Canceling;
                GoalInfo {
                    goal_id: goal.id,
                    stamp: goal.accepted,
                }
            });
            let return_code = match cancelling {
                Some(_) => CancelGoalResponseEnum::None,
                None => CancelGoalResponseEnum::GoalTerminated,
            };
            let response = CancelGoalResponse {
                return_code,
                goals_canceling: cancelling.into_iter().collect(),
            };
            let _ = self.server.send_cancel_response(request, response);
            self.tell();
        }
        while let Ok(Some((request, asked))) = self.server.receive_result_request() {
            self.waiting.push((request, asked.goal_id));
        }
        self.answer();
    }

    /// Returns the goal that has come since the last call; `None` if none has, or if it was
    /// cancelled since.
    pub(crate) fn new_goal(&mut self) -> Option<Pose> {
        let goal = self.goals.last_mut()?;
        let is_new = core::mem::take(&mut goal.is_new);
        (is_new && goal.status == GoalStatusEnum::Executing).then_some(goal.pose)
    }

    /// Returns whether the pursued goal is to be given up, for a new one or for none.
    pub(crate) fn is_called_off(&self) -> bool {
        let last = self.goals.last();
        last.is_some_and(|goal| goal.status == GoalStatusEnum::Canceling || goal.is_new)
    }

    /// Tells how far the robot has come.
    pub(crate) fn feed_back(&self, feedback: NavigateFeedback) {
        if let Some(goal) = self.goals.last().filter(|goal| goal.is_pursued()) {
            let _ = self.server.send_feedback(goal.id, feedback);
        }
    }

    /// Ends the pursued goal with `status`, or as cancelled if it is to be, and tells why. A goal
    /// that nobody has taken up yet stays.
    pub(crate) fn end(&mut self, status: GoalStatusEnum, why: &str) {
        if self.goals.last().is_some_and(|goal| !goal.is_new) {
            self.end_last(status, why);
        }
    }

    /// Ends the last goal, taken up or not.
    fn end_last(&mut self, status: GoalStatusEnum, why: &str) {
        let Some(goal) = self.goals.last_mut() else {
            return;
        };
        goal.status = match goal.status {
            GoalStatusEnum::Executing => status,
            GoalStatusEnum::Canceling => GoalStatusEnum::Canceled,
            _ => return,
        };
        goal.result = NavigateResult {
            error_code: u16::from(goal.status == GoalStatusEnum::Aborted),
            error_msg: why.to_owned(),
        };
        self.goals
            .drain(..self.goals.len().saturating_sub(REMEMBERED));
        self.tell();
        self.answer();
    }

    /// Sends results to those that wait for them.
    fn answer(&mut self) {
        let Self {
            server,
            goals,
            waiting,
        } = self;
        waiting.retain(|(request, id)| {
            let goal = goals.iter().find(|goal| goal.id == *id);
            let (status, result) = match goal {
                Some(goal) if goal.is_pursued() => return true,
                Some(goal) => (goal.status, goal.result.clone()),
                None => (GoalStatusEnum::Unknown, NavigateResult::default()),
            };
            let _ = server.send_result(*request, GetResultResponse { status, result });
            false
        });
    }

    fn tell(&self) {
        let status = |goal: &Goal| GoalStatus {
            goal_info: GoalInfo {
                goal_id: goal.id,
                stamp: goal.accepted,
            },
            status: goal.status,
        };
        let status_list = self.goals.iter().map(status).collect();
        let _ = self
            .server
            .send_goal_statuses(GoalStatusArray { status_list });
    }
}

impl Goal {
    fn is_pursued(&self) -> bool {
        matches!(
            self.status,
            GoalStatusEnum::Executing | GoalStatusEnum::Canceling
        )
    }
}
