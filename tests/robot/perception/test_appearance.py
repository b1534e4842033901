import pytest

from memorymaze.robot.perception.appearance import appearance_score


@pytest.mark.parametrize(
    ("asked", "color", "material", "score"),
    [
        pytest.param("red", "red", None, 1.0, id="same"),
        pytest.param("red", "dark red", None, 1.0, id="a shade of it"),
        pytest.param("crimson", "red", None, 1.0, id="another word"),
        pytest.param("gray", "grey", None, 1.0, id="another spelling"),
        pytest.param("dark blue", "blue", None, 0.6, id="shade not known"),
        pytest.param("light blue", "dark blue", None, 0.0, id="other shade"),
        pytest.param("red", "blue", None, 0.0, id="other colour"),
        pytest.param("blue", "turquoise", None, 0.6, id="neighbour"),
        pytest.param("red", "red and yellow", None, 1.0, id="one of two"),
        pytest.param("red", None, None, 0.75, id="not known"),
        pytest.param("wooden", "light oak", None, 1.0, id="oak is wood"),
        pytest.param("oak", None, "wood", 0.6, id="wood may be oak"),
        pytest.param("metal", "brown", "wood", 0.0, id="wood is no metal"),
        pytest.param("metal", "grey", "steel", 1.0, id="steel is metal"),
        pytest.param("silver", "silver", None, 1.0, id="colour and material"),
        pytest.param("glass", "clear", None, 1.0, id="clear is glass"),
        pytest.param("brown wooden", "brown", "wood", 1.0, id="both"),
        pytest.param("brown wooden", "brown", "steel", 0.0, id="one is wrong"),
        pytest.param("brown", "wood", None, 1.0, id="wood is brown"),
        pytest.param("", "red", None, 1.0, id="nothing asked"),
    ],
)
def test_looks_fit_or_contradict(
    asked: str, color: str | None, material: str | None, score: float
) -> None:
    assert appearance_score(asked, color, material) == score
