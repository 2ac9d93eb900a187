"""Teaching by a person: drawing, understanding, performing, learning, a session that is kept."""
