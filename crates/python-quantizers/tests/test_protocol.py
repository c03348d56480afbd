"""The estimators keep scikit-learn's protocol, by its own checks, in whatever version is installed."""

import numpy as np
import pytest
import sklearn
from sklearn.base import clone
from sklearn.model_selection import GridSearchCV
from sklearn.pipeline import make_pipeline
from sklearn.preprocessing import StandardScaler
from sklearn.utils.estimator_checks import parametrize_with_checks
from tolman_quantizers import GNG, SOINN, EquilibriumGNG, NotFittedError

ALL = [GNG(), GNG(max_units=10, growth_period=5, batch_size=8), EquilibriumGNG(), SOINN()]
NEW = tuple(map(int, sklearn.__version__.split(".")[:2])) >= (1, 6)


@parametrize_with_checks(ALL)
def test_it_passes_scikit_learns_checks(estimator, check):
    check(estimator)


def test_no_check_is_evaded():
    for estimator in ALL:
        if NEW:
            tags = estimator.__sklearn_tags__()
            assert not tags._skip_test and not tags.no_validation
        else:
            tags = estimator._get_tags()
            assert not tags["_skip_test"] and not tags["no_validation"] and not tags["_xfail_checks"]


@pytest.mark.parametrize("estimator", ALL, ids=repr)
def test_it_works_in_pipelines_and_searches(estimator):
    x = np.random.default_rng(0).random((300, 3))
    pipeline = make_pipeline(StandardScaler(), clone(estimator)).fit(x)
    assert pipeline.predict(x).shape == (300,) and np.isfinite(pipeline.score(x))
    assert "<" in pipeline._repr_html_()
    assert GridSearchCV(estimator, {"max_age": [20, 50]}, cv=3).fit(x).best_params_["max_age"] in (20, 50)
    with pytest.raises(NotFittedError):
        clone(estimator).predict(x)


def test_columns_in_another_order_are_refused():
    pandas = pytest.importorskip("pandas")
    frame = pandas.DataFrame(np.random.default_rng(0).random((200, 3)).astype(np.float32), columns=list("abc"))
    gng = GNG(max_units=10, growth_period=10).fit(frame)
    assert gng.units_.dtype == np.float32 and list(gng.feature_names_in_) == list("abc")
    for ask in (gng.predict, gng.partial_fit, gng.transform, gng.score):
        with pytest.raises(ValueError, match="[Ff]eature names"):
            ask(frame[["c", "b", "a"]])
    names = gng.set_output(transform="pandas").transform(frame).columns
    assert list(names[:2]) == ["gng0", "gng1"]
    assert gng.topographic_error(frame) <= 0.2
    assert list(gng.to_frame().columns) == [*"abc", "cluster"]
